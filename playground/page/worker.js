// Runs the planner in a worker: one request at a time, so that the page stays responsive.
'use strict';
const core = createCore({ print: () => {}, printErr: () => {} });

function textOf(module, pointer) { return module.UTF8ToString(pointer); }

function setParameter(module, name, value) {
  const write = text => {
    const size = module.lengthBytesUTF8(text) + 1, at = module._malloc(size);
    module.stringToUTF8(text, at, size);
    return at;
  };
  const places = [write(name), write(value)], done = module._playground_set_parameter(...places) !== 0;
  for (const place of places) module._free(place);
  return done;
}

const OUTPUTS = ['summary', 'path', 'pieces', 'trajectory', 'startTree', 'goalTree', 'steps', 'goals', 'slot', 'bounds', 'field'];
function output(module, name) {
  const which = OUTPUTS.indexOf(name), size = module._playground_output_size(which);
  if (!size) return new Float64Array(0);
  const at = module._playground_output(which) >> 3;
  return module.HEAPF64.slice(at, at + size);
}

function setScene(module, question) {
  if (question.cells) {
    const at = module._playground_cells(question.cells.length);
    module.HEAPU8.set(question.cells, at);
  }
  const at = module._playground_numbers(question.numbers.length) >> 3;
  module.HEAPF64.set(question.numbers, at);
  return module._playground_scene(question.numbers.length) !== 0;
}

function answer(module, question) {
  const answer = { id: question.id, ok: false, message: '', kind: question.kind };
  const failed = () => { answer.message = textOf(module, module._playground_message()); return answer; };
  if (!setScene(module, question)) return failed();
  for (const name of ['goals', 'slot', 'bounds']) answer[name] = output(module, name);
  const isFree = pose => module._playground_is_free(...pose) !== 0;
  answer.startIsFree = isFree(question.start);
  answer.freeGoals = [];
  for (let i = 0; i + 3 <= answer.goals.length; i += 3) answer.freeGoals.push(isFree(answer.goals.slice(i, i + 3)));
  if (question.field && module._playground_field(question.field)) answer.field = output(module, 'field');
  answer.plans = [];
  for (const parameters of question.parameters) {
    const plan = {}, byTextbook = parameters.planner === 'textbook_hybrid_astar';
    module._playground_reset_parameters();
    // The set first: it changes the others.
    const names = byTextbook ? [] : Object.keys(parameters).sort((a, b) => (b === 'parameter_set') - (a === 'parameter_set'));
    for (const name of names) if (!setParameter(module, name, parameters[name])) return failed();
    if (!(byTextbook ? module._playground_plan_by_textbook(question.seconds) : module._playground_plan(question.seconds, 0))) return failed();
    plan.message = textOf(module, module._playground_message());
    for (const name of ['summary', 'path', 'pieces']) plan[name] = output(module, name);
    if (question.trajectory) {
      if (module._playground_trajectory(question.trajectory)) plan.trajectory = output(module, 'trajectory');
      else plan.trajectoryMessage = textOf(module, module._playground_message());
    }
    if (question.trace && module._playground_trace(question.seconds, question.trace))
      for (const name of ['startTree', 'goalTree', 'steps']) plan[name] = output(module, name);
    answer.plans.push(plan);
  }
  answer.ok = true;
  return answer;
}

if (typeof onmessage !== 'undefined') {
  core.then(module => {
    postMessage({ kind: 'ready', parameters: JSON.parse(textOf(module, module._playground_parameters())),
                  vehicles: JSON.parse(textOf(module, module._playground_vehicles())) });
    onmessage = event => {
      const begin = performance.now();
      let result;
      try { result = answer(module, event.data); }
      catch (error) { result = { id: event.data.id, kind: event.data.kind, ok: false, message: 'the planner has failed: ' + error.message, broken: true }; }
      result.milliseconds = performance.now() - begin;
      postMessage(result);
    };
  }, error => postMessage({ kind: 'broken', message: String(error) }));
}
