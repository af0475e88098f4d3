// The pairs of a study, last part: one view (zoom, pan, divider, exposure, cursor) over all of them.
// ---- zoom, pan, divider -----------------------------------------------------------------------
function setZoom(zoom, x = view.x, y = view.y) {
  // What stands at (x, y), shares of the picture, stays where it is seen.
  const before = corner(), next = Math.min(32, Math.max(1, zoom));
  const u = (x - before.x) / before.size, v = (y - before.y) / before.size;
  view.zoom = next;
  view.x = x + (0.5 - u) / next;
  view.y = y + (0.5 - v) / next;
  settle();
}

function settle() {
  const {x, y, size} = corner();
  view.x = x + size / 2;
  view.y = y + size / 2;
  byId('zoom-value').textContent = (view.zoom < 10 ? view.zoom.toFixed(1) : view.zoom.toFixed(0)) +
    '×';
  document.body.classList.toggle('zoomed', view.zoom > 1);
  refresh();
}

function setSplit(percent) {
  view.split = Math.min(100, Math.max(0, percent));
  for (const s of screens) {
    s.pair.style.setProperty('--split', view.split + '%');
    s.handle.setAttribute('aria-valuenow', Math.round(view.split));
    s.handle.setAttribute('aria-valuetext', `${Math.round(view.split)} % fitted, ` +
      `${Math.round(100 - view.split)} % literature`);
  }
}

const share = (pane, event) => {
  const box = pane.getBoundingClientRect(), {x, y, size} = corner();
  return {u: (event.clientX - box.left) / box.width, width: box.width,
    x: x + size * (event.clientX - box.left) / box.width,
    y: y + size * (event.clientY - box.top) / box.height};
};

function watch(s, pane, isPair) {
  let drag = null;
  pane.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    const at = share(pane, event);
    const near = isPair && Math.abs(at.u * 100 - view.split) * at.width < 2600;
    drag = {kind: near || (isPair && view.zoom === 1) ? 'split' : view.zoom > 1 ? 'pan' : 'look',
      x: event.clientX, y: event.clientY, viewX: view.x, viewY: view.y, moved: false};
    pane.setPointerCapture(event.pointerId);
  });
  pane.addEventListener('pointermove', (event) => {
    const at = share(pane, event);
    if (!drag || drag.kind === 'look') {
      setCursor(at.x * colour.width, at.y * colour.height);
      return;
    }
    if (!drag.moved && Math.hypot(event.clientX - drag.x, event.clientY - drag.y) < 3) return;
    drag.moved = true;
    if (drag.kind === 'split') {
      setSplit(100 * at.u);
    } else {
      view.x = drag.viewX - (event.clientX - drag.x) / at.width / view.zoom;
      view.y = drag.viewY - (event.clientY - drag.y) / at.width / view.zoom;
      settle();
    }
  });
  pane.addEventListener('pointerup', (event) => {
    if (drag && !drag.moved) {
      const at = share(pane, event);
      setCursor(at.x * colour.width, at.y * colour.height);
    }
    drag = null;
  });
  pane.addEventListener('pointercancel', () => { drag = null; });
  pane.addEventListener('dblclick', (event) => {
    const at = share(pane, event);
    setZoom(view.zoom * (event.shiftKey ? 0.5 : 2), at.x, at.y);
  });
  pane.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && !event.metaKey) return;  // the page scrolls
    event.preventDefault();
    const at = share(pane, event);
    setZoom(view.zoom * 2 ** (-event.deltaY / 200), at.x, at.y);
  }, {passive: false});
  pane.addEventListener('keydown', (event) => {
    if (event.target !== pane || event.ctrlKey || event.metaKey || event.altKey) return;
    const moves = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    if (moves[event.key]) {
      const far = colour.rest.step * (event.shiftKey ? 10 : 1);
      setCursor(view.cursor.x + far * moves[event.key][0], view.cursor.y + far * moves[event.key][1]);
      const {x, y, size} = corner();
      const cx = view.cursor.x / colour.width, cy = view.cursor.y / colour.height;
      if (cx < x || cx > x + size || cy < y || cy > y + size) {
        view.x = cx;
        view.y = cy;
        settle();
      }
      s.figure.querySelector('.spoken').textContent =
        s.figure.querySelector('.where').textContent + ': S0 fitted ' +
        [...s.figure.querySelectorAll('.readout tbody tr:first-child td')].slice(0, 3)
          .map((td) => td.textContent).join(', ');
    } else if (event.key === '+' || event.key === '=') {
      setZoom(view.zoom * 1.5, view.cursor.x / colour.width, view.cursor.y / colour.height);
    } else if (event.key === '-') {
      setZoom(view.zoom / 1.5);
    } else if (event.key === '0') {
      setZoom(1);
    } else {
      return;
    }
    event.preventDefault();
  });
}

function watchDivider(s) {
  s.handle.addEventListener('keydown', (event) => {
    const far = event.shiftKey ? 10 : 2;
    const to = {ArrowLeft: view.split - far, ArrowDown: view.split - far,
      ArrowRight: view.split + far, ArrowUp: view.split + far, PageUp: view.split + 10,
      PageDown: view.split - 10, Home: 0, End: 100}[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    setSplit(to);
  });
}

function watchTools() {
  const slider = byId('exposure');
  const say = () => {
    const text = (view.exposure > 0 ? '+' : '') + minus(view.exposure.toFixed(1)) + ' EV';
    byId('exposure-value').textContent = text;
    slider.setAttribute('aria-valuetext', text);
  };
  slider.addEventListener('input', () => {
    view.exposure = +slider.value;
    say();
    paintAll();
    refresh();
  });
  byId('curve').addEventListener('change', (event) => {
    view.curve = event.target.value;
    paintAll();
    refresh();
  });
  byId('difference').addEventListener('change', (event) => {
    view.difference = event.target.value;
    paintDifferences();
    refresh();
  });
  byId('zoom-in').addEventListener('click', () => setZoom(view.zoom * 1.5));
  byId('zoom-out').addEventListener('click', () => setZoom(view.zoom / 1.5));
  byId('zoom-reset').addEventListener('click', () => {
    Object.assign(view, atFirst);
    for (const name of ['exposure', 'curve', 'difference']) byId(name).value = view[name];
    say();
    paintAll();
    paintDifferences();
    setSplit(view.split);
    settle();
  });
  say();
}

// ---- start ------------------------------------------------------------------------------------
async function start() {
  [colour, spectral] = await Promise.all([assemble(data.colour),
    data.spectral ? assemble(data.spectral) : null]);
  if (!spectral) byId('difference').querySelector('[value=spectral]').remove();
  figures.forEach((figure, number) => {
    const {width, height} = colour.firsts[2 * number];
    const source = () => Object.assign(document.createElement('canvas'), {width, height});
    const pair = figure.querySelector('.pair'), map = figure.querySelector('.map');
    const s = {figure, pair, handle: figure.querySelector('.handle'),
      over: figure.querySelector('.over'), under: figure.querySelector('.under'),
      map: map.querySelector('canvas'), fitted: source(), literature: source(),
      difference: source()};
    for (const pane of [pair, map]) pane.style.aspectRatio = `${colour.width} / ${colour.height}`;
    screens.push(s);
    watch(s, pair, true);
    watch(s, map, false);
    watchDivider(s);
  });
  watchTools();
  // The cursor begins on the metal, right of its middle.
  let best = [Infinity, 0, 0];
  for (let y = 0; y < colour.height; ++y) {
    for (let x = 0; x < colour.width; ++x) {
      const far = Math.hypot(x - 0.62 * colour.width, y - 0.55 * colour.height);
      if (colour.own[y * colour.width + x] && far < best[0]) best = [far, x, y];
    }
  }
  chooseReference();
  paintAll();
  paintDifferences();
  setSplit(view.split);
  settle();
  setCursor(best[1], best[2]);
  new ResizeObserver(refresh).observe(document.querySelector('main'));
  window.addEventListener('beforeprint', drawAll);
  document.body.classList.add('viewer-ready');
}

start().catch((error) => {
  for (const figure of figures) {
    figure.querySelector('.where').textContent =
      'This browser cannot unpack the embedded numbers: ' + error.message;
  }
});
