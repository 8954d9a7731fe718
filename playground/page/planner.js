// The page's side of the workers: each receives the newest request after it has answered the previous one.

const Planner = (() => {
  const source = document.getElementById('worker').textContent;
  const address = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
  let count = 0;

  function employ() {
    let worker = null, busy = null, waiting = null, ready = null, onReady = null, timer = 0;
    const about = new Promise(resolve => { onReady = resolve; });

    function begin() {
      worker = new Worker(address);
      worker.onmessage = event => {
        const answer = event.data;
        if (answer.kind === 'ready') { ready = answer; onReady(answer); send(); return; }
        if (answer.kind === 'broken') { onReady({ broken: answer.message }); return; }
        clearTimeout(timer);
        const asked = busy;
        busy = null;
        if (answer.broken) { worker.terminate(); ready = null; begin(); }
        if (asked) asked.resolve({ ...answer, stale: waiting !== null, question: asked.question });
        send();
      };
      worker.onerror = event => { event.preventDefault(); onReady({ broken: event.message }); };
    }

    function send() {
      if (busy || !waiting || !ready) return;
      busy = waiting;
      waiting = null;
      worker.postMessage(busy.question);
      // Restarts a worker that exceeds its limit by far, for example on a huge map.
      timer = setTimeout(() => {
        const asked = busy;
        worker.terminate();
        busy = null; ready = null;
        begin();
        asked.resolve({ ok: false, id: asked.question.id, message: 'the planner did not answer in time', question: asked.question });
      }, 1000 * (15 + 6 * asked(busy.question)));
    }
    const asked = question => (question.seconds * 2 + (question.trajectory || 0)) * question.parameters.length;

    // Resolves with the answer, or with undefined when a newer request replaced it.
    function ask(question) {
      return new Promise(resolve => {
        if (!worker) begin();
        if (waiting) waiting.resolve(undefined);
        waiting = { question: { ...question, id: ++count }, resolve };
        send();
      });
    }

    return { about, ask, begin };
  }

  function numbersOf(scene) {
    const all = Formats.VEHICLE_FIELDS.map(field => scene.vehicle[field]), outline = scene.vehicle.outline || [];
    all.push(outline.length, ...outline.flat());
    all.push(...scene.start);
    if (scene.slot) {
      const slot = scene.slot;
      all.push(1, Formats.KINDS.indexOf(slot.kind), ...slot.pose, slot.length, slot.width, Formats.ENTRIES.indexOf(slot.entry), slot.angle, Formats.SIDES.indexOf(slot.side), slot.depth === null ? -1 : slot.depth, slot.lateral_offset);
    } else {
      all.push(0, scene.goals.length);
      for (const goal of scene.goals) all.push(...goal);
    }
    if (scene.map) all.push(1, scene.map.columns, scene.map.rows, scene.map.resolution, ...scene.map.origin, scene.map.unknownIsOccupied ? 1 : 0);
    else {
      all.push(0, scene.polygons.length);
      for (const polygon of scene.polygons) all.push(polygon.length);
      for (const polygon of scene.polygons) for (const [x, y] of polygon) all.push(x, y);
    }
    return Float64Array.from(all);
  }

  // Plans during a drag must not wait for the optimisation of a drive.
  const hasty = employ(), patient = employ();
  hasty.begin();
  return { about: hasty.about, ask: question => (question.hasty ? hasty : patient).ask(question), numbersOf };
})();
