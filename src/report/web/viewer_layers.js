// The pairs of a study, first part: the half floats that the page carries, taken apart as
// report/picture_data.h lays them out. The parts are joined in one function (viewer_script()).
const data = JSON.parse(document.getElementById('picture-data').textContent);
const figures = data.pairs.map((id) => document.querySelector(`.viewer[data-pair="${id}"]`));
const byId = (id) => document.getElementById(id);

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
  const grids = new Map();
  const places = (step) => {
    if (grids.has(step)) return grids.get(step);
    const width = Math.ceil(group.width / step), height = Math.ceil(group.height / step);
    const shared = [], mine = [];
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        (own[y * step * group.width + x * step] ? mine : shared).push(y * width + x);
      }
    }
    const grid = {step, width, height, size: width * height, shared, mine};
    grids.set(step, grid);
    return grid;
  };
  const first = places(group.first), rest = places(group.rest);
  // What is shared stands on a grid of its own, of which a coarser one takes every so-many-th.
  const shared = await Promise.all(group.shared.map(async (text, s) => {
    const its = await halves(text), grid = s === 0 ? first : rest;
    if (!its) return null;
    const out = new Uint16Array(group.planes * grid.size);
    for (let plane = 0; plane < group.planes; ++plane) {
      grid.shared.forEach((p, i) => {
        out[plane * grid.size + p] = its[plane * grid.shared.length + i];
      });
    }
    return out;
  }));
  const rows = [], firsts = [];
  for (const [number, picture] of group.pictures.entries()) {
    const own0 = places(group.firsts[number]);
    firsts.push(own0);
    rows.push(await Promise.all(picture.map(async (text, s) => {
      const its = await halves(text), common = shared[s];
      if (!its && !common) return null;
      const grid = s === 0 ? own0 : rest, from = s === 0 ? first : rest;
      const far = grid.step / from.step;
      const out = new Uint16Array(group.planes * grid.size);
      for (let plane = 0; plane < group.planes; ++plane) {
        if (common) {
          for (const p of grid.shared) {
            const q = Math.floor(p / grid.width) * far * from.width + p % grid.width * far;
            out[plane * grid.size + p] = common[plane * from.size + q];
          }
        }
        if (its) {
          grid.mine.forEach((p, i) => {
            out[plane * grid.size + p] = its[plane * grid.mine.length + i];
          });
        }
      }
      return out;
    })));
  }
  return {first, firsts, rest, rows, own, planes: group.planes, width: group.width,
    height: group.height};
}

// The place on `grid` of what stands at (x, y) of the finest one.
const placeOn = (grid, x, y) => Math.floor(y / grid.step) * grid.width + Math.floor(x / grid.step);

const value = (layer, index) => layer ? fromHalf[layer[index]] : 0;

// Degree (0 to 1) and angle (degrees, 0 to 180) of linear polarisation.
function linear(s0, s1, s2) {
  const angle = Math.atan2(s2, s1) * 90 / Math.PI;
  return {degree: s0 > 0 ? Math.hypot(s1, s2) / s0 : NaN, angle: angle < 0 ? angle + 180 : angle};
}
