// The pairs of a study, first part: the half floats that the page carries, taken apart as
// report/picture_data.h lays them out. The parts are joined in one function (viewer_script()).
const data = JSON.parse(document.getElementById('picture-data').textContent);
const figures = data.metals.map((id) => document.querySelector(`.viewer[data-metal="${id}"]`));
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
