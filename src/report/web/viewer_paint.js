// The pairs of a study, second part: what is shown, and how numbers become pictures.
// ---- state ------------------------------------------------------------------------------------
const atFirst = {zoom: 1, x: 0.5, y: 0.5, split: 50, exposure: 0, curve: 'srgb', difference: 'log'};
const view = {...atFirst, cursor: null};
let colour = null, spectral = null;
const screens = [];  // one a figure

const luminance = [0.2126, 0.7152, 0.0722];

// ---- tone mapping: half bits to display bytes -----------------------------------------------------
const display = new Uint8ClampedArray(65536);
let reference = 1;

// The key of Reinhard et al. 2002, eqs. 1 and 2: the metals' log-average luminance becomes 0.18.
function chooseReference() {
  let sum = 0, count = 0;
  colour.rows.forEach((rows, picture) => {
    const grid = colour.firsts[picture];
    for (const p of grid.mine) {
      if (p % 7) continue;
      const y = meanY(rows, 0, grid, p);
      if (!(y > 0) || y === Infinity) continue;
      sum += Math.log(y);
      ++count;
    }
  });
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

function paintPicture(canvas, picture) {
  const {width, height, size} = colour.firsts[picture], s0 = colour.rows[picture][0];
  const image = canvas.getContext('2d').createImageData(width, height);
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
function differenceOf(pair, kind) {
  const a = colour.rows[2 * pair], b = colour.rows[2 * pair + 1], s0 = colour.firsts[2 * pair];
  const size = s0.size;
  if (kind === 'log' || kind === 'signed') {
    return {grid: s0, at: (p) => {
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
    const x = spectral.rows[2 * pair], y = spectral.rows[2 * pair + 1], grid = spectral.first;
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
    return linear(meanY(rows, 0, s0, placeOn(s0, x, y)),
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

function paintDifference(canvas, pair, kind) {
  const {map, low, high} = differences[kind], colours = maps[map];
  const {grid, at} = differenceOf(pair, kind);
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
  screens.forEach((s, pair) => {
    paintPicture(s.fitted, 2 * pair);
    paintPicture(s.literature, 2 * pair + 1);
  });
}

function paintDifferences() {
  const {map, low, high, unit} = differences[view.difference], colours = maps[map];
  const stops = [];
  for (let i = 0; i <= 16; ++i) {
    const at = 3 * Math.round(i * 255 / 16);
    stops.push(`rgb(${colours[at]} ${colours[at + 1]} ${colours[at + 2]})`);
  }
  screens.forEach((s, pair) => {
    paintDifference(s.difference, pair, view.difference);
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
