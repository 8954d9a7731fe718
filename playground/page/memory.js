// The scene across reloads of the page, in the storage of its tab. One for each address.

const Memory = (() => {
  const KEY = 'scene of ' + location.pathname + location.search;
  const images = new WeakMap();  // of maps, which never change

  const toText = bytes => { let text = ''; for (const each of bytes) text += String.fromCharCode(each); return 'base64:' + btoa(text); };
  const fromText = text => text.startsWith('base64:') ? Uint8Array.from(atob(text.slice(7)), each => each.charCodeAt(0)) : text;
  function filesOf(map) {
    if (!images.has(map)) images.set(map, Formats.mapFiles(map).map(([name, content]) => [name, typeof content === 'string' ? content : toText(content)]));
    return images.get(map);
  }

  // Settings: {bundled, name, parameters, compare}. `bundled` is the bundled scene if it is unchanged, `name` what the list calls another.
  function store(scene, settings) {
    const own = settings.bundled ? {} : { scenario: Formats.toYaml(scene), files: scene.map ? filesOf(scene.map) : [] };
    try { sessionStorage.setItem(KEY, JSON.stringify({ hash: location.hash, ...settings, ...own })); } catch (error) { forget(); /* without storage, or too large for it */ }
  }
  function forget() { try { sessionStorage.removeItem(KEY); } catch (error) { /* no storage */ } }

  // What was stored while the page had its present address, or null. Throws an Error if it is damaged. A link that is
  // followed, and not reloaded, has its own scene.
  function recall() {
    const [visit] = performance.getEntriesByType('navigation');
    let text = null;
    if (visit && visit.type === 'navigate' && /^#[zj]/.test(location.hash)) return null;
    try { text = sessionStorage.getItem(KEY); } catch (error) { /* no storage */ }
    if (text === null) return null;
    const found = JSON.parse(text);
    if (typeof found.hash !== 'string') throw new Error('it has no address');
    if (found.hash !== location.hash) return null;
    if (typeof found.bundled !== 'string') { found.scenario = String(found.scenario); found.files = new Map(found.files.map(([name, content]) => [name, fromText(content)])); }
    return found;
  }
  return { store, recall, forget };
})();
