// The pairs of a study: one view (zoom, pan, exposure, cursor) over all of them, made from the
// half floats that the page carries (report/picture_data.h says how they are laid out).
'use strict';
(() => {
const holder = document.getElementById('picture-data');
if (!holder) return;
const data = JSON.parse(holder.textContent);
const figures = data.metals.map((id) => document.querySelector(`.viewer[data-metal="${id}"]`));
const byId = (id) => document.getElementById(id);

// ---- numbers ----------------------------------------------------------------------------------
const fromHalf = new Float32Array(65536);
for (let h = 0; h < 65536; ++h) {
  const exponent = h >> 10 & 31, significand = h & 1023;
  const size = exponent === 0 ? significand * 2 ** -24
    : exponent === 31 ? (significand ? NaN : Infinity)
    : (1024 + significand) * 2 ** (exponent - 25);
  fromHalf[h] = h & 0x8000 ? -size : size;
}

async function inflate(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The high bytes stand before the low ones; "" is a layer of zeros.
async function halves(text) {
  if (!text) return null;
  const bytes = await inflate(text), count = bytes.length / 2;
  const out = new Uint16Array(count);
  for (let i = 0; i < count; ++i) out[i] = bytes[i] << 8 | bytes[count + i];
  return out;
}

// A group of layers: what all pictures share and what each has of its own, put together again as
// planes of whole pictures. rows[picture][S] holds plane after plane; null: zeros.
async function assemble(group) {
  const own = await inflate(group.own);
  const places = (step) => {
    const width = Math.ceil(group.width / step), height = Math.ceil(group.height / step);
    const shared = [], mine = [];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        (own[y * step * group.width + x * step] ? mine : shared).push(y * width + x);
      }
    }
    return {step, width, height, size: width * height, shared, mine};
  };
  const first = places(group.first);
  const rest = group.rest === group.first ? first : places(group.rest);
  const common = await Promise.all(group.shared.map(halves));
  const rows = [];
  for (const picture of group.pictures) {
    rows.push(await Promise.all(picture.map(async (text, s) => {
      const its = await halves(text);
      if (!its && !common[s]) return null;
      const {size, shared, mine} = s === 0 ? first : rest;
      const out = new Uint16Array(group.planes * size);
      for (let plane = 0; plane < group.planes; ++plane) {
        if (common[s]) shared.forEach((p, i) => {
          out[plane * size + p] = common[s][plane * shared.length + i];
        });
        if (its) mine.forEach((p, i) => { out[plane * size + p] = its[plane * mine.length + i]; });
      }
      return out;
    })));
  }
  return {first, rest, rows, own, planes: group.planes, width: group.width, height: group.height};
}

const value = (layer, index) => layer ? fromHalf[layer[index]] : 0;

// Degree (0 to 1) and angle (degrees, 0 to 180) of linear polarisation.
function linear(s0, s1, s2) {
  const angle = Math.atan2(s2, s1) * 90 / Math.PI;
  return {degree: s0 > 0 ? Math.hypot(s1, s2) / s0 : NaN, angle: angle < 0 ? angle + 180 : angle};
}

// ---- state ------------------------------------------------------------------------------------
const view = {zoom: 1, x: 0.5, y: 0.5, split: 50, exposure: 0, curve: 'srgb', difference: 'log',
  cursor: null};
let colour = null, spectral = null;
const screens = [];  // one a figure

const luminance = [0.2126, 0.7152, 0.0722];

// ---- tone mapping: half bits to display bytes -----------------------------------------------------
const display = new Uint8ClampedArray(65536);
let reference = 1;

// The key of Reinhard et al. 2002, eqs. 1 and 2: the metals' log-average luminance becomes 0.18.
function chooseReference() {
  let sum = 0, count = 0;
  for (const rows of colour.rows) {
    for (let p = 0; p < colour.first.size; p += 7) {
      const y = colour.own[p] ? meanY(rows, 0, colour.first, p) : 0;
      if (!(y > 0) || y === Infinity) continue;
      sum += Math.log(y);
      ++count;
    }
  }
  if (count) reference = Math.exp(sum / count) / 0.18;
}

function fillDisplay() {
  const scale = 2 ** view.exposure / reference, white = 16;
  for (let h = 0; h < 65536; ++h) {
    let v = fromHalf[h] * scale;
    if (!(v > 0)) v = 0;
    // Reinhard et al. 2002, eq. 4, with four times the reference as the white point.
    if (view.curve === 'reinhard') v = v * (1 + v / white) / (1 + v);
    v = Math.min(1, v);
    display[h] = 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055) + 0.5;
  }
}

function paintPicture(canvas, s0) {
  const size = colour.width * colour.height;
  const image = canvas.getContext('2d').createImageData(colour.width, colour.height);
  for (let p = 0, o = 0; p < size; ++p, o += 4) {
    image.data[o] = display[s0[p]];
    image.data[o + 1] = display[s0[size + p]];
    image.data[o + 2] = display[s0[2 * size + p]];
    image.data[o + 3] = 255;
  }
  canvas.getContext('2d').putImageData(image, 0, 0);
}

// ---- differences ------------------------------------------------------------------------------
const differences = {
  log: {map: 'sequential', low: data.log[0], high: data.log[1],
    unit: 'log₁₀ of the mean |fitted − literature| of linear R, G, B'},
  signed: {map: 'diverging', low: -0.1, high: 0.1,
    unit: 'fitted − literature, mean of linear R, G, B'},
  spectral: {map: 'sequential', low: 0, high: 0.2,
    unit: 'root mean square over the spectrum of S0, relative to the literature’s'},
  dolp: {map: 'diverging', low: -0.1, high: 0.1,
    unit: 'degree of linear polarisation, fitted − literature'},
  aolp: {map: 'diverging', low: -1, high: 1,
    unit: 'angle of linear polarisation, fitted − literature, degrees; grey: below 1 % polarised'},
};

function meanY(rows, s, grid, p) {
  let sum = 0;
  for (let c = 0; c < 3; ++c) sum += luminance[c] * value(rows[s], c * grid.size + p);
  return sum;
}

// {grid, at(p)}: NaN is grey; undefined: the same in both pictures.
function differenceOf(metal, kind) {
  const a = colour.rows[2 * metal], b = colour.rows[2 * metal + 1], size = colour.first.size;
  if (kind === 'log' || kind === 'signed') {
    return {grid: colour.first, at: (p) => {
      let absolute = 0, signed = 0;
      for (let c = 0; c < 3; ++c) {
        const d = fromHalf[a[0][c * size + p]] - fromHalf[b[0][c * size + p]];
        absolute += Math.abs(d) / 3;
        signed += d / 3;
      }
      if (kind === 'signed') return absolute === 0 ? undefined : signed;
      return absolute === 0 ? undefined : Math.log10(absolute);
    }};
  }
  if (kind === 'spectral') {
    const x = spectral.rows[2 * metal], y = spectral.rows[2 * metal + 1], grid = spectral.first;
    return {grid, at: (p) => {
      let moved = 0, total = 0;
      for (let w = 0; w < spectral.planes; ++w) {
        const u = value(x[0], w * grid.size + p), v = value(y[0], w * grid.size + p);
        moved += (u - v) ** 2;
        total += v * v;
      }
      return moved === 0 ? undefined : Math.sqrt(moved / total);
    }};
  }
  const grid = colour.rest, step = grid.step;
  const at = (rows, p) => {
    const x = p % grid.width * step, y = Math.floor(p / grid.width) * step;
    return linear(meanY(rows, 0, colour.first, y * colour.width + x),
      meanY(rows, 1, grid, p), meanY(rows, 2, grid, p));
  };
  return {grid, at: (p) => {
    const u = at(a, p), v = at(b, p);
    if (u.degree === v.degree && u.angle === v.angle) return undefined;
    if (kind === 'dolp') return u.degree - v.degree;
    if (!(Math.min(u.degree, v.degree) >= 0.01)) return NaN;
    const turn = u.angle - v.angle;
    return turn - 180 * Math.round(turn / 180);
  }};
}

const mapBytes = (text) => Uint8Array.from(text.match(/../g), (pair) => parseInt(pair, 16));
const maps = {sequential: mapBytes(data.sequential), diverging: mapBytes(data.diverging)};

function paintDifference(canvas, metal, kind) {
  const {map, low, high} = differences[kind], colours = maps[map];
  const {grid, at} = differenceOf(metal, kind);
  canvas.width = grid.width;
  canvas.height = grid.height;
  const image = canvas.getContext('2d').createImageData(grid.width, grid.height);
  for (let p = 0, o = 0; p < grid.size; ++p, o += 4) {
    const d = at(p);
    image.data[o + 3] = 255;
    if (Number.isNaN(d)) {
      image.data[o] = image.data[o + 1] = image.data[o + 2] = 128;
      continue;
    }
    const t = d === undefined ? (map === 'diverging' ? 0.5 : 0) : (d - low) / (high - low);
    const i = 3 * Math.round(255 * Math.min(1, Math.max(0, t)));
    for (let c = 0; c < 3; ++c) image.data[o + c] = colours[i + c];
  }
  canvas.getContext('2d').putImageData(image, 0, 0);
}

// ---- drawing ----------------------------------------------------------------------------------
// The left upper corner of what is shown, and its size, as shares of the picture.
function corner() {
  const size = 1 / view.zoom, most = 1 - size;
  return {x: Math.min(most, Math.max(0, view.x - size / 2)),
    y: Math.min(most, Math.max(0, view.y - size / 2)), size};
}

function draw(canvas, source) {
  const box = canvas.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
  const width = Math.max(1, Math.round(box.width * ratio));
  const height = Math.max(1, Math.round(box.height * ratio));
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext('2d'), {x, y, size} = corner();
  const pixel = width / (size * source.width);
  context.imageSmoothingEnabled = pixel < 2;
  context.imageSmoothingQuality = 'high';
  context.drawImage(source, x * source.width, y * source.height, size * source.width,
    size * source.height, 0, 0, width, height);
  if (!view.cursor) return;
  // A ring about the pixel of the read-out, dark on light and light on dark.
  const px = ((view.cursor.x + 0.5) / colour.width - x) / size * width;
  const py = ((view.cursor.y + 0.5) / colour.height - y) / size * height;
  const radius = Math.max(5 * ratio, 0.75 * width / (size * colour.width));
  for (const [stroke, line] of [['rgba(0,0,0,.8)', 3.5], ['#fff', 1.5]]) {
    context.beginPath();
    context.arc(px, py, radius, 0, 2 * Math.PI);
    context.strokeStyle = stroke;
    context.lineWidth = line * ratio;
    context.stroke();
  }
}

function drawAll() {
  for (const s of screens) {
    draw(s.over, s.fitted);
    draw(s.under, s.literature);
    draw(s.map, s.difference);
  }
}

function paintAll() {
  fillDisplay();
  screens.forEach((s, metal) => {
    paintPicture(s.fitted, colour.rows[2 * metal][0]);
    paintPicture(s.literature, colour.rows[2 * metal + 1][0]);
  });
}

function paintDifferences() {
  const {map, low, high, unit} = differences[view.difference], colours = maps[map];
  const stops = [];
  for (let i = 0; i <= 16; ++i) {
    const at = 3 * Math.round(i * 255 / 16);
    stops.push(`rgb(${colours[at]} ${colours[at + 1]} ${colours[at + 2]})`);
  }
  screens.forEach((s, metal) => {
    paintDifference(s.difference, metal, view.difference);
    s.figure.querySelector('.ramp').style.background = `linear-gradient(90deg,${stops})`;
    const labels = s.figure.querySelectorAll('.scale span');
    [low, (low + high) / 2, high].forEach((v, i) => {
      labels[i].textContent = String(+v.toFixed(3)).replace('-', '−');
    });
    s.figure.querySelector('.unit').textContent = unit;
  });
}

let planned = false;
function refresh() {
  if (planned) return;
  planned = true;
  requestAnimationFrame(() => { planned = false; drawAll(); });
}

// ---- the read-out -----------------------------------------------------------------------------
const minus = (text) => text.replaceAll('-', '−');
function shown(v) {
  if (!Number.isFinite(v)) return '–';
  if (v === 0) return '0';
  return minus(Math.abs(v) < 0.01 ? v.toExponential(2) : v.toPrecision(4));
}

function spectrumDrawing(metal) {
  if (!spectral) return '';
  const grid = spectral.first, nm = data.spectral.nm, n = nm.length;
  const gx = Math.min(grid.width - 1,
    Math.floor((view.cursor.x + 0.5) / colour.width * spectral.width / grid.step));
  const gy = Math.min(grid.height - 1,
    Math.floor((view.cursor.y + 0.5) / colour.height * spectral.height / grid.step));
  const p = gy * grid.width + gx;
  const curves = [0, 1].map((which) => {
    const rows = spectral.rows[2 * metal + which];
    const s0 = [], degree = [];
    for (let w = 0; w < n; ++w) {
      const i = w * grid.size + p;
      s0.push(value(rows[0], i));
      degree.push(linear(s0[w], value(rows[1], i), value(rows[2], i)).degree);
    }
    return {s0, degree};
  });
  const left = 52, right = 334;
  const x = (w) => left + (right - left) * (nm[w] - nm[0]) / (nm[n - 1] - nm[0]);
  const panel = (key, top, bottom, label, digits) => {
    const most = Math.max(1e-9, ...curves.flatMap((c) => c[key].filter(Number.isFinite)));
    const path = (values) => values.map((v, w) => (w ? 'L' : 'M') + x(w).toFixed(1) + ' ' +
      (bottom - (bottom - top) * (Number.isFinite(v) ? v : 0) / most).toFixed(1)).join('');
    return `<path d="M${left} ${top}V${bottom}H${right}" fill="none" stroke="currentColor" ` +
      `opacity=".5"/><text x="${left - 5}" y="${top + 8}" text-anchor="end">` +
      `${most.toPrecision(digits)}</text><text x="${left - 5}" y="${bottom}" ` +
      `text-anchor="end">0</text><text x="${left}" y="${top - 5}" ` +
      `font-weight="600">${label}</text>` +
      `<path d="${path(curves[1][key])}" class="line-1"/>` +
      `<path d="${path(curves[0][key])}" class="line-0"/>`;
  };
  const ticks = [400, 500, 600, 700].filter((t) => t >= nm[0] && t <= nm[n - 1]).map((t) =>
    `<text x="${(left + (right - left) * (t - nm[0]) / (nm[n - 1] - nm[0])).toFixed(1)}" ` +
    `y="204" text-anchor="middle">${t}</text>`).join('');
  const exr = `${gx * grid.step * data.spectral.step}, ${gy * grid.step * data.spectral.step}`;
  return `<svg viewBox="0 0 340 222" role="img" aria-label="S0 and degree of linear polarisation ` +
    `against wavelength at the cursor, fitted and literature" data-pixel="${exr}">` +
    panel('s0', 16, 108, 'S0 against wavelength', 3) +
    panel('degree', 134, 190, 'Degree of linear polarisation', 2) + ticks +
    `<text x="${(left + right) / 2}" y="219" text-anchor="middle">wavelength (nm)</text></svg>`;
}

function readOut() {
  if (!view.cursor) return;
  const {x, y} = view.cursor, first = colour.first, rest = colour.rest;
  const p = y * colour.width + x, q = y / rest.step * rest.width + x / rest.step;
  screens.forEach((s, metal) => {
    const pair = [colour.rows[2 * metal], colour.rows[2 * metal + 1]];
    const names = ['fitted', 'literature'];
    let rows = '';
    for (let i = 0; i < 4; ++i) {
      const grid = i === 0 ? first : rest, at = i === 0 ? p : q;
      pair.forEach((r, which) => {
        rows += '<tr>' + (which ? '' : `<th scope="rowgroup" rowspan="2">S${i}</th>`) +
          `<th scope="row" class="of-${which}">${names[which]}</th>` + [0, 1, 2].map((c) =>
          `<td>${shown(value(r[i], c * grid.size + at))}</td>`).join('') + '</tr>';
      });
    }
    pair.forEach((r, which) => {
      const l = linear(meanY(r, 0, first, p), meanY(r, 1, rest, q), meanY(r, 2, rest, q));
      rows += '<tr>' + (which ? '' : '<th scope="rowgroup" rowspan="2">Pol.</th>') +
        `<th scope="row" class="of-${which}">${names[which]}</th><td colspan="3">` +
        `DoLP ${shown(100 * l.degree)} %, AoLP ` +
        `${l.degree >= 0.001 ? l.angle.toFixed(2) + '°' : '–'}</td></tr>`;
    });
    s.figure.querySelector('.where').textContent =
      `Pixel ${x * data.step}, ${y * data.step} of the EXR` +
      (colour.own[p] ? '' : ' (background, the same in both)');
    s.figure.querySelector('.readout tbody').innerHTML = rows;
    s.figure.querySelector('.spectrum').innerHTML = spectrumDrawing(metal);
  });
}

// S1 to S3 may be there for some pixels only: the cursor stands on those.
function setCursor(x, y) {
  const step = colour.rest.step;
  const snap = (v, most) =>
    Math.min(Math.floor((most - 1) / step), Math.max(0, Math.floor(v / step))) * step;
  view.cursor = {x: snap(x, colour.width), y: snap(y, colour.height)};
  readOut();
  refresh();
}

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
    slider.value = view.exposure = 0;
    say();
    paintAll();
    setSplit(50);
    setZoom(1);
  });
  say();
}

// ---- start ------------------------------------------------------------------------------------
async function start() {
  [colour, spectral] = await Promise.all([assemble(data.colour),
    data.spectral ? assemble(data.spectral) : null]);
  if (!spectral) byId('difference').querySelector('[value=spectral]').remove();
  figures.forEach((figure) => {
    const source = () => Object.assign(document.createElement('canvas'),
      {width: colour.width, height: colour.height});
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
  setSplit(50);
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
})();
