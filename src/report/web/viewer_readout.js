// The pairs of a study, third part: numbers and spectra at the cursor.
const minus = (text) => text.replaceAll('-', '−');
function shown(v) {
  if (!Number.isFinite(v)) return '–';
  if (v === 0) return '0';
  return minus(Math.abs(v) < 0.01 ? v.toExponential(2) : v.toPrecision(4));
}

function spectrumDrawing(pair) {
  if (!spectral) return '';
  const grid = spectral.first, nm = data.spectral.nm, n = nm.length;
  const gx = Math.min(grid.width - 1,
    Math.floor((view.cursor.x + 0.5) / colour.width * spectral.width / grid.step));
  const gy = Math.min(grid.height - 1,
    Math.floor((view.cursor.y + 0.5) / colour.height * spectral.height / grid.step));
  const p = gy * grid.width + gx;
  const curves = [0, 1].map((which) => {
    const rows = spectral.rows[2 * pair + which];
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
  const {x, y} = view.cursor, rest = colour.rest, q = placeOn(rest, x, y);
  screens.forEach((s, number) => {
    const first = colour.firsts[2 * number], p = placeOn(first, x, y);
    const pair = [colour.rows[2 * number], colour.rows[2 * number + 1]];
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
      (colour.own[y * colour.width + x] ? '' : ' (background, the same in both)');
    s.figure.querySelector('.readout tbody').innerHTML = rows;
    s.figure.querySelector('.spectrum').innerHTML = spectrumDrawing(number);
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
