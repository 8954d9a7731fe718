// Guides a visitor: hints step by step, and why the trees of a search grow as they do.

const Guide = (() => {
  const byId = id => document.getElementById(id);
  const STEPS = [
    { text: 'Drag the car. The plan follows at once.', ends: ['moved start'] },
    { text: 'Turn the car by its round handle.', ends: ['turn'] },
    { text: 'Drag a grey obstacle into the path. The planner finds another.', ends: ['moved polygon', 'placed', 'corner'] },
    { text: 'Press Search to see how the trees find the path.', ends: ['search'] }];
  const TOOLS = {
    car: matchMedia('(pointer: coarse)').matches ? 'Tap where a parked car stands.' : 'Click where a parked car stands. By keys: arrows move it, Q and E turn it, Enter places it.',
    polygon: 'Click corner by corner. Enter or a click on the first corner closes the outline.',
    slot: 'Drag from one corner of the slot to the opposite one.' };
  const done = new Set();

  // Every kind of change ends the hints that ask for it.
  function happened(what) { STEPS.forEach((step, index) => { if (step.ends.includes(what)) done.add(index); }); hint(); }
  function hint() {
    const next = STEPS.findIndex((_, index) => !done.has(index)), text = TOOLS[Tools.tool] || (next < 0 ? '' : `${next + 1} of ${STEPS.length}: ${STEPS[next].text}`);
    if (byId('hint').textContent !== text) byId('hint').textContent = text;
    byId('hint').hidden = !text;
  }

  const { element } = Panels, metres = value => `${value.toFixed(1)} m`, SIDES = { start: "the start's tree", goal: "the goal's tree" };
  // g + w h of a node, with the weight if it is one number.
  function sum(node, textbook) {
    const far = Panels.valueOf('heuristic_weight_far'), isOne = far === Panels.valueOf('heuristic_weight_near') && !Panels.parameters.parameter_set;
    const weight = textbook ? '1' : isOne ? far : 'weight';
    return Number.isFinite(node[7]) ? `${metres(node[6])} so far + ${weight} \u00d7 ${metres(node[7])} to go` : `${metres(node[6])} so far, and no way on is known`;
  }

  // step: {count, all, side, node} with the node that was expanded last, or null at the end; under: {side, node} below the pointer.
  function why(step, under, textbook) {
    const box = byId('why-step');
    const first = !step ? 'There is no search to show.' : step.node ? `Expansion ${step.count} of ${step.all}: ${SIDES[step.side]} grows at the ringed pose, ${sum(step.node, textbook)}.` : `All ${step.all} expansions. Move the slider to see them one by one.`;
    const second = under ? `Under the pointer, in ${SIDES[under.side]}: ${sum(under.node, textbook)}.` : 'Point at a dot to see its numbers and its way.';
    if (box.dataset.text === first + second) return;
    box.dataset.text = first + second;
    box.replaceChildren(element('p', {}, first), element('p', {}, second));
  }

  return { happened, hint, why };
})();
