// Files to open and save: scenarios, TPCAP cases, maps. Invalid ones throw an Error of one line.

const Formats = (() => {
  const short = text => { const line = String(text).replace(/\s+/g, ' ').trim(); return line.length > 60 ? line.slice(0, 60) + '...' : line; };
  const fail = (file, line, what) => { throw new Error(`${file}${line ? ':' + line : ''}: ${what}`); };

  // A mapping in YAML. js-yaml reads it and reports the line of a syntax error.
  function readYaml(file, text) {
    let found;
    try { found = jsyaml.load(text, { schema: jsyaml.CORE_SCHEMA }); } catch (error) { fail(file, error.mark && error.mark.line + 1, error.reason || error.message); }
    if (found === undefined || found === null) fail(file, 0, 'contains only blanks');
    if (typeof found !== 'object' || Array.isArray(found)) fail(file, 0, "must be a mapping with lines such as 'key: value'");
    return found;
  }

  const isNumber = value => typeof value === 'number' && Number.isFinite(value);
  function numbers(file, what, value, count) {
    if (!Array.isArray(value) || value.length !== count || !value.every(isNumber)) fail(file, 0, `${what} must be a list of ${count} numbers`);
    return value.slice();
  }

  const VEHICLE_FIELDS = ['wheelbase', 'front_overhang', 'rear_overhang', 'width', 'max_steering_angle', 'max_speed', 'max_acceleration', 'max_steering_rate'];
  const KINDS = ['perpendicular', 'parallel', 'angled'], ENTRIES = ['reverse', 'forward', 'either'], SIDES = ['right', 'left', 'either'];

  function vehicle(file, value, known) {
    if (value === undefined || value === null) return { ...known.find(each => each.name === 'tpcap') };
    if (typeof value === 'string') {
      const found = known.find(each => each.name === value);
      if (!found) fail(file, 0, `unknown vehicle '${short(value)}'; known: ${known.map(each => each.name).join(', ')}`);
      return { ...found };
    }
    const tpcap = known.find(each => each.name === 'tpcap'), made = { name: String(value.name || 'custom') };
    for (const key of Object.keys(value)) if (key !== 'name' && key !== 'outline' && !VEHICLE_FIELDS.includes(key)) fail(file, 0, `vehicle: unknown key '${short(key)}'`);
    VEHICLE_FIELDS.forEach((field, index) => {
      if (value[field] === undefined && (index >= 5 || (value.outline !== undefined && index >= 1 && index <= 3))) made[field] = tpcap[field];
      else if (!isNumber(value[field])) fail(file, 0, `vehicle: ${field} must be a number`);
      else made[field] = value[field];
    });
    if (value.outline !== undefined) setOutline(file, made, value);
    return made;
  }

  // The outline, counter-clockwise, and the lengths of its bounding rectangle unless the file gives them.
  function setOutline(file, car, value) {
    if (!Array.isArray(value.outline)) fail(file, 0, 'vehicle: outline must be a list of [x, y]');
    car.outline = value.outline.map(corner => numbers(file, 'vehicle: a corner of outline', corner, 2));
    if (Scene.area(car.outline) < 0) car.outline.reverse();
    const xs = car.outline.map(([x]) => x), ys = car.outline.map(([, y]) => Math.abs(y));
    const lengths = { front_overhang: Math.max(...xs, car.wheelbase) - car.wheelbase, rear_overhang: -Math.min(...xs, 0), width: 2 * Math.max(...ys) };
    for (const field of Object.keys(lengths)) if (value[field] === undefined) car[field] = lengths[field];
  }

  function slot(file, value) {
    const known = ['kind', 'pose', 'length', 'width', 'entry', 'angle', 'side', 'depth', 'lateral_offset'];
    for (const key of Object.keys(value)) if (!known.includes(key)) fail(file, 0, `slot: unknown key '${short(key)}'`);
    const choice = (name, names, otherwise) => {
      if (value[name] === undefined && otherwise) return otherwise;
      if (!names.includes(value[name])) fail(file, 0, `slot: ${name} must be ${names.join(', ')}`);
      return value[name];
    };
    const number = (name, otherwise) => {
      if (value[name] === undefined && otherwise !== undefined) return otherwise;
      if (!isNumber(value[name])) fail(file, 0, `slot: ${name} must be a number`);
      return value[name];
    };
    if (value.angle !== undefined && value.kind !== 'angled') fail(file, 0, `slot: angle is given for a slot of the kind ${short(value.kind)}; only angled slots have one`);
    return { kind: choice('kind', KINDS), pose: numbers(file, 'slot: pose', value.pose, 3), length: number('length'), width: number('width'),
      entry: choice('entry', ENTRIES, 'reverse'), angle: number('angle', Math.PI / 4), side: choice('side', SIDES, 'either'),
      depth: value.depth === undefined ? null : number('depth'), lateral_offset: number('lateral_offset', 0) };
  }

  function polygons(file, list) {
    if (list === null) fail(file, 0, 'polygons is nothing; write [] for none');
    if (!Array.isArray(list)) fail(file, 0, 'polygons must be a list of polygons, each a list of [x, y]');
    return list.map((polygon, index) => {
      if (!Array.isArray(polygon) || !polygon.length) fail(file, 0, `polygon ${index + 1} must be a list of corners [x, y]`);
      return polygon.map(corner => numbers(file, `a corner of polygon ${index + 1}`, corner, 2));
    });
  }

  const nameOf = file => file.replace(/^.*[\\/]/, '').replace(/\.[^.]*$/, '');

  // A scene from a scenario's text. `other(name)` returns another file's text or bytes, or undefined.
  async function readScenario(file, text, known, other) {
    const yaml = readYaml(file, text);
    if (yaml.image !== undefined) return mapScene(await readMap(file, text, other), nameOf(file), known);
    const keys = ['name', 'map', 'polygons', 'vehicle', 'start', 'goal', 'slot', 'unknown_is_occupied'];
    for (const key of Object.keys(yaml)) if (!keys.includes(key)) fail(file, 0, `unknown key '${short(key)}'; known: ${keys.join(', ')}`);
    if ((yaml.map === undefined) === (yaml.polygons === undefined)) fail(file, 0, yaml.map === undefined ? 'neither map nor polygons is given; one of them must be' : 'both map and polygons are given; give one of them');
    if (yaml.polygons !== undefined && yaml.unknown_is_occupied !== undefined) fail(file, 0, 'unknown_is_occupied is given for a world of polygons; only cells of a map are unknown');
    if ((yaml.goal === undefined) === (yaml.slot === undefined)) fail(file, 0, yaml.goal === undefined ? 'neither goal nor slot is given; one of them must be' : 'both goal and slot are given; give one of them');
    const scene = { name: String(yaml.name || nameOf(file)), vehicle: vehicle(file, yaml.vehicle, known), start: numbers(file, 'start', yaml.start, 3),
      goals: yaml.goal === undefined ? [] : [numbers(file, 'goal', yaml.goal, 3)], slot: yaml.slot === undefined ? null : slot(file, yaml.slot || {}),
      polygons: [], map: null };
    if (yaml.polygons !== undefined) scene.polygons = polygons(file, yaml.polygons);
    else if (yaml.map && typeof yaml.map === 'object') scene.polygons = polygons(file, yaml.map.polygons === undefined ? null : yaml.map.polygons);
    else {
      const mapText = await other(String(yaml.map));
      if (typeof mapText !== 'string') fail(file, 0, `its map '${short(yaml.map)}' is missing: drop it together with this file`);
      scene.map = await readMap(String(yaml.map), mapText, other);
      scene.map.unknownIsOccupied = !['false', 'no', 'off', 'n'].includes(String(yaml.unknown_is_occupied).toLowerCase());
    }
    return scene;
  }

  function readTpcap(file, text, known) {
    const fields = text.replace(/^\uFEFF/, '').split(/[,\n]/).map(each => each.trim()).filter(each => each !== '');
    const values = fields.map((each, index) => {
      const value = Number(each);
      if (each === '' || !Number.isFinite(value)) fail(file, 0, `number ${index + 1} is '${short(each)}'; it must be a finite decimal number`);
      return value;
    });
    const wrap = angle => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
    if (values.length < 7) fail(file, 0, `too few numbers: the ${values.length} in the file end before the number of obstacles`);
    const count = values[6];
    if (!Number.isInteger(count) || count < 0 || 7 + count > values.length) fail(file, 0, `number 7 is ${count}; the number of obstacles must be a whole number that fits the file`);
    const corners = values.slice(7, 7 + count);
    if (corners.some(each => !Number.isInteger(each) || each < 3)) fail(file, 0, 'an obstacle needs at least 3 corners');
    const total = corners.reduce((sum, each) => sum + each, 0);
    if (values.length - 7 - count !== 2 * total) fail(file, 0, `the vertex counts require ${2 * total} coordinates and the file holds ${values.length - 7 - count}`);
    let at = 7 + count;
    return { name: nameOf(file), vehicle: vehicle(file, 'tpcap', known), start: [values[0], values[1], wrap(values[2])], goals: [[values[3], values[4], wrap(values[5])]], slot: null,
      polygons: corners.map(n => Array.from({ length: n }, () => [values[at++], values[at++]])), map: null };
  }

  // Pixels: { width, height, white, at(index) } with the brightness, or -1 for a pixel that is not opaque.
  function readPgm(file, bytes) {
    let at = 2;
    const plain = String.fromCharCode(bytes[0], bytes[1]) === 'P2';
    const number = () => {
      for (;;) {
        while (at < bytes.length && bytes[at] <= 32) ++at;
        if (bytes[at] !== 35) break;
        while (at < bytes.length && bytes[at] !== 10) ++at;
      }
      let value = 0, any = false;
      while (at < bytes.length && bytes[at] >= 48 && bytes[at] <= 57) { value = 10 * value + bytes[at++] - 48; any = true; }
      if (!any) fail(file, 0, 'the PGM image ends too early, or contains a word that is not a number');
      return value;
    };
    const width = number(), height = number(), white = number();
    if (width < 1 || height < 1 || width * height > 1 << 24) fail(file, 0, `an image of ${width} x ${height} pixels is too small or too large`);
    if (white < 1 || white > 65535) fail(file, 0, `the largest value is ${white}; it must be 1 to 65535`);
    const pixels = new Int32Array(width * height);
    if (plain) for (let i = 0; i < pixels.length; ++i) pixels[i] = number();
    else {
      ++at;
      const size = white > 255 ? 2 : 1;
      if (bytes.length - at < size * pixels.length) fail(file, 0, 'the PGM image is cut short');
      for (let i = 0; i < pixels.length; ++i) pixels[i] = size === 2 ? 256 * bytes[at + 2 * i] + bytes[at + 2 * i + 1] : bytes[at + i];
    }
    return { width, height, white, pixels };
  }

  async function readPng(file, bytes) {
    let bitmap;
    try { bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }), { colorSpaceConversion: 'none' }); } catch (error) { fail(file, 0, 'is not a PNG image'); }
    const canvas = document.createElement('canvas');
    canvas.width = bitmap.width; canvas.height = bitmap.height;
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(bitmap, 0, 0);
    const data = context.getImageData(0, 0, bitmap.width, bitmap.height).data, pixels = new Int32Array(bitmap.width * bitmap.height);
    for (let i = 0; i < pixels.length; ++i) pixels[i] = data[4 * i + 3] < 255 ? -1 : Math.round((data[4 * i] + data[4 * i + 1] + data[4 * i + 2]) / 3);
    return { width: bitmap.width, height: bitmap.height, white: 255, pixels };
  }

  const isPgm = bytes => bytes[0] === 80 && (bytes[1] === 50 || bytes[1] === 53);
  const isPng = bytes => bytes[0] === 137 && bytes[1] === 80 && bytes[2] === 78;

  async function readMap(file, text, other) {
    const yaml = readYaml(file, text), image = String(yaml.image || '');
    if (!isNumber(yaml.resolution) || yaml.resolution <= 0) fail(file, 0, 'resolution must be a positive number of metres per cell');
    const origin = numbers(file, 'origin', yaml.origin, 3);
    const bytes = await other(image);
    if (!bytes || typeof bytes === 'string') fail(file, 0, `its image '${short(image)}' is missing: drop it together with this file`);
    if (!isPgm(bytes) && !isPng(bytes)) fail(image, 0, 'is neither a PGM (P2, P5) nor a PNG image');
    const picture = isPgm(bytes) ? readPgm(image, bytes) : await readPng(image, bytes);
    for (const key of ['occupied_thresh', 'free_thresh']) if (!isNumber(yaml[key])) fail(file, 0, `${key} must be a number`);
    const rules = { negate: yaml.negate === 1 || yaml.negate === true, occupied: yaml.occupied_thresh, free: yaml.free_thresh, raw: String(yaml.mode).toLowerCase() === 'raw' };
    return { ...cellsOf(picture, rules), resolution: yaml.resolution, origin, unknownIsOccupied: true, name: nameOf(file).replace(/_map$/, '') };
  }

  function cellsOf(picture, rules) {
    const { width, height, white, pixels } = picture, cells = new Uint8Array(width * height);
    for (let row = 0; row < height; ++row)
      for (let column = 0; column < width; ++column) {
        const brightness = pixels[row * width + column];
        let cell = 2;
        if (brightness >= 0) {
          const dark = rules.negate ? brightness : white - brightness;
          let probability = dark / white;
          if (rules.raw) { const percent = Math.round(255 * brightness / white); probability = percent > 100 ? NaN : percent / 100; }
          cell = probability > rules.occupied ? 1 : probability < rules.free ? 0 : 2;
        }
        cells[(height - 1 - row) * width + column] = cell;
      }
    return { columns: width, rows: height, cells };
  }

  // A map without a problem: from one free place to the farthest that is joined to it by free places.
  function mapScene(map, name, known) {
    const car = vehicle(name, 'vw_golf8', known), { columns, rows, resolution, cells } = map, [ox, oy, yaw] = map.origin, margin = 0.3;
    const step = Math.max(1, Math.round(1 / resolution)), back = Math.ceil((car.rear_overhang + margin) / resolution), front = Math.ceil((car.wheelbase + car.front_overhang + margin) / resolution), half = Math.ceil((car.width / 2 + margin) / resolution);
    // The rear axle is in a cell, the car along the rows of the map.
    const fits = (column, row) => {
      if (column < back || row < half || column + front >= columns || row + half >= rows) return false;
      for (let r = row - half; r <= row + half; ++r) for (let c = column - back; c <= column + front; ++c) if (cells[r * columns + c] !== 0) return false;
      return true;
    };
    const place = ([column, row]) => {
      const x = (column + 0.5) * resolution, y = (row + 0.5) * resolution;
      return [ox + x * Math.cos(yaw) - y * Math.sin(yaw), oy + x * Math.sin(yaw) + y * Math.cos(yaw), yaw];
    };
    // The largest of the joined regions, each in the order of a flood from its first place.
    const seen = new Set();
    let best = [];
    for (let row = half; row < rows; row += step)
      for (let column = back; column < columns; column += step) {
        const region = [], add = (c, r) => { if (!seen.has(r * columns + c) && fits(c, r)) { seen.add(r * columns + c); region.push([c, r]); } };
        add(column, row);
        for (let i = 0; i < region.length; ++i) for (const [dc, dr] of [[step, 0], [-step, 0], [0, step], [0, -step]]) add(region[i][0] + dc, region[i][1] + dr);
        if (region.length > best.length) best = region;
      }
    if (!best.length) fail(name, 0, 'the map has no free place for a car');
    return { name, vehicle: car, start: place(best[0]), goals: [place(best[best.length - 1])], slot: null, polygons: [], map };
  }

  // The scene from dropped or chosen files.
  async function open(files, known) {
    const contents = new Map();
    for (const file of files) {
      if (file.size > 64 << 20) fail(file.name, 0, 'is larger than 64 MB');
      contents.set(file.name, new Uint8Array(await file.arrayBuffer()));
    }
    const isText = bytes => !isPgm(bytes) && !isPng(bytes) && !bytes.subarray(0, 4096).includes(0);
    const decode = bytes => new TextDecoder().decode(bytes);
    const other = async name => {
      const bytes = contents.get(name.replace(/^.*[\\/]/, ''));
      return bytes === undefined ? undefined : isText(bytes) ? decode(bytes) : bytes;
    };
    const texts = [...contents].filter(([, bytes]) => isText(bytes)).map(([name, bytes]) => [name, decode(bytes)]);
    const scenarios = texts.filter(([, text]) => /^(start|slot|goal)\s*:/m.test(text)), cases = texts.filter(([, text]) => Number.isFinite(parseFloat(text)) && text.trim().split(/[,\n]/)[0].trim() !== '' && Number.isFinite(Number(text.trim().split(/[,\n]/)[0])));
    const maps = texts.filter(([, text]) => /^image\s*:/m.test(text));
    if (scenarios.length) return readScenario(scenarios[0][0], scenarios[0][1], known, other);
    if (cases.length) return readTpcap(cases[0][0], cases[0][1], known);
    if (maps.length) return mapScene(await readMap(maps[0][0], maps[0][1], other), nameOf(maps[0][0]), known);
    const images = [...contents].filter(([, bytes]) => isPgm(bytes) || isPng(bytes));
    if (images.length) {
      const [name, bytes] = images[0], picture = isPgm(bytes) ? readPgm(name, bytes) : await readPng(name, bytes);
      return mapScene({ ...cellsOf(picture, { negate: false, occupied: 0.65, free: 0.196 }), resolution: 0.1, origin: [0, 0, 0], unknownIsOccupied: true, name: nameOf(name) }, nameOf(name), known);
    }
    fail(files[0] ? files[0].name : 'nothing', 0, 'is not a scenario (YAML), TPCAP case (CSV) or map (YAML with PGM or PNG)');
  }

  const number = value => String(Math.round(value * 1e9) / 1e9);
  const list = values => '[' + values.map(number).join(', ') + ']';

  function toYaml(scene) {
    const lines = [`# Written by the playground of Improved A* for automatic parking.`, `name: ${JSON.stringify(scene.name)}`, 'vehicle:', `  name: ${JSON.stringify(scene.vehicle.name)}`];
    for (const field of VEHICLE_FIELDS) lines.push(`  ${field}: ${number(scene.vehicle[field])}`);
    if (scene.vehicle.outline) lines.push(`  outline: [${scene.vehicle.outline.map(list).join(', ')}]`);
    lines.push(`start: ${list(scene.start)}`);
    if (scene.slot) {
      const slot = scene.slot;
      lines.push('slot:', `  kind: ${slot.kind}`, `  pose: ${list(slot.pose)}`, `  length: ${number(slot.length)}`, `  width: ${number(slot.width)}`, `  entry: ${slot.entry}`);
      if (slot.kind === 'angled') lines.push(`  angle: ${number(slot.angle)}`);
      if (slot.side !== 'either') lines.push(`  side: ${slot.side}`);
      if (slot.depth !== null) lines.push(`  depth: ${number(slot.depth)}`);
      if (slot.lateral_offset) lines.push(`  lateral_offset: ${number(slot.lateral_offset)}`);
    } else lines.push(`goal: ${list(scene.goals[0])}`);
    if (scene.map) {
      lines.push(`map: ${scene.map.name}_map.yaml`);
      if (!scene.map.unknownIsOccupied) lines.push('unknown_is_occupied: false');
    } else {
      lines.push('polygons:' + (scene.polygons.length ? '' : ' []'));
      for (const polygon of scene.polygons) lines.push(`  - [${polygon.map(list).join(', ')}]`);
    }
    return lines.join('\n') + '\n';
  }

  // The two files of the map of a scene.
  function mapFiles(map) {
    const header = new TextEncoder().encode(`P5\n${map.columns} ${map.rows}\n255\n`), bytes = new Uint8Array(header.length + map.cells.length);
    bytes.set(header);
    for (let row = 0; row < map.rows; ++row)
      for (let column = 0; column < map.columns; ++column)
        bytes[header.length + (map.rows - 1 - row) * map.columns + column] = [254, 0, 205][map.cells[row * map.columns + column]];
    return [[`${map.name}_map.yaml`, `image: ${map.name}.pgm\nresolution: ${number(map.resolution)}\norigin: ${list(map.origin)}\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n`], [`${map.name}.pgm`, bytes]];
  }

  const table = (names, rows) => names.join(',') + '\n' + rows.map(row => row.join(',')).join('\n') + '\n';

  return { readScenario, readTpcap, open, toYaml, mapFiles, table, VEHICLE_FIELDS, KINDS, ENTRIES, SIDES };
})();
