// The style and the script that every page carries.
#pragma once

namespace drude {

inline constexpr char page_style[] = R"css(
:root{color-scheme:light dark;--ground:#fbfaf8;--card:#ffffff;--ink:#1d1f23;--soft:#5d6068;
--line:#e2dfd9;--accent:#9a4a1c;--wash:#f3efe8;
--series-0:#0072b2;--series-1:#d55e00;--series-2:#009e73;--series-3:#c0639a;--series-4:#c98a00;
--series-5:#3c9fd6;--series-6:#8c7500;--series-7:#555555}
@media (prefers-color-scheme:dark){:root{--ground:#15171b;--card:#1d2025;--ink:#e8e6e1;
--soft:#a3a5ac;--line:#33373e;--accent:#e8a273;--wash:#262a30;
--series-0:#4aa8e8;--series-1:#ff8a3d;--series-2:#2fc79a;--series-3:#e39cc4;--series-4:#f0b429;
--series-5:#8fd0f5;--series-6:#cdb94a;--series-7:#a8a8a8}}
*{box-sizing:border-box}
html{scroll-behavior:smooth;scroll-padding-top:3.4rem}
body{margin:0;background:var(--ground);color:var(--ink);
font:16px/1.6 system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans",sans-serif}
header,main,footer{max-width:76rem;margin:0 auto;padding:0 1.25rem}
header{padding-top:3.2rem}
.eyebrow{margin:0;color:var(--accent);font-size:.82rem;font-weight:600;letter-spacing:.09em;
text-transform:uppercase}
h1{margin:.25rem 0 .6rem;font-size:clamp(1.9rem,4.5vw,2.9rem);line-height:1.12;font-weight:680;
letter-spacing:-.02em;text-wrap:balance}
.lead{max-width:46rem;margin:0 0 1.6rem;color:var(--soft);font-size:1.12rem}
nav{position:sticky;top:0;z-index:9;background:var(--ground);border-bottom:1px solid var(--line)}
nav ul{display:flex;flex-wrap:nowrap;gap:.2rem 1.3rem;overflow-x:auto;max-width:76rem;
margin:0 auto;padding:.6rem 1.25rem;list-style:none}
nav a{color:var(--soft);text-decoration:none;white-space:nowrap;font-size:.93rem}
nav a:hover{color:var(--accent)}
a:focus-visible,.wide:focus-visible{outline:2px solid var(--accent);outline-offset:2px}
section{margin:2.6rem 0 3.4rem}
h2{margin:0 0 .9rem;font-size:1.65rem;line-height:1.2;letter-spacing:-.012em}
h3{margin:2rem 0 .6rem;font-size:1.12rem}
p,.items{max-width:46rem}
p{margin:.7rem 0}
.note{padding:.85rem 1.1rem;background:var(--wash);border-left:3px solid var(--accent);
border-radius:0 .4rem .4rem 0}
figure{margin:1.1rem 0;padding:1rem;background:var(--card);border:1px solid var(--line);
border-radius:.6rem;break-inside:avoid}
figcaption{margin-top:.7rem;color:var(--soft);font-size:.9rem;line-height:1.45}
figure img,figure svg.plot{display:block;width:100%;height:auto}
.grid{display:grid;gap:1.1rem;grid-template-columns:repeat(auto-fit,minmax(min(100%,25rem),1fr));
align-items:start}
.grid>*{margin:0;min-width:0}
.facts{display:grid;grid-template-columns:max-content 1fr;gap:.3rem 1.2rem;margin:1rem 0}
.facts dt{color:var(--soft)}
.facts dd{margin:0;overflow-wrap:anywhere}
@media (max-width:36rem){.facts{grid-template-columns:1fr;gap:0}.facts dd{margin-bottom:.6rem}}
.wide{overflow-x:auto;margin:1.1rem 0}
table{border-collapse:collapse;width:100%;font-size:.93rem}
caption{max-width:min(46rem,calc(100vw - 2.5rem));padding-bottom:.5rem;color:var(--soft);text-align:left}
th,td{padding:.42rem .8rem;border-bottom:1px solid var(--line);text-align:left;
vertical-align:top}
thead th{border-bottom:2px solid var(--line);color:var(--soft);font-weight:600;
vertical-align:bottom}
tbody th{font-weight:600}
.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
pre{overflow-x:auto;padding:.8rem 1rem;background:var(--wash);border-radius:.4rem;
font:.86rem/1.5 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;white-space:pre-wrap;
overflow-wrap:anywhere}
.compare{position:relative;overflow:hidden;border-radius:.3rem;touch-action:pan-y}
.compare .top{position:absolute;inset:0;clip-path:inset(0 calc(100% - var(--split,50%)) 0 0)}
.compare .tag{position:absolute;top:.6rem;z-index:1;padding:.1rem .6rem;border-radius:1rem;
background:rgba(0,0,0,.62);color:#fff;font-size:.82rem;pointer-events:none}
.compare .tag.left{left:.6rem}.compare .tag.right{right:.6rem}
.compare .bar{position:absolute;top:0;bottom:0;left:var(--split,50%);width:2px;margin-left:-1px;
background:#fff;box-shadow:0 0 5px rgba(0,0,0,.7);pointer-events:none}
.compare .bar::after{content:"\2194";position:absolute;top:50%;left:50%;width:2.1rem;height:2.1rem;
transform:translate(-50%,-50%);border-radius:50%;background:#fff;color:#222;text-align:center;
line-height:2.05rem;box-shadow:0 1px 6px rgba(0,0,0,.5)}
.compare input{position:absolute;inset:0;width:100%;height:100%;margin:0;opacity:0;
cursor:ew-resize}
.compare:has(input:focus-visible){outline:3px solid var(--accent);outline-offset:3px}
.swap{position:relative}
.swap .over{position:absolute;inset:0}
.swap:hover .over,.swap:focus .over{visibility:hidden}
.swap:focus-visible{outline:3px solid var(--accent);outline-offset:3px}
.swap img{image-rendering:pixelated}
footer{padding-top:1rem;padding-bottom:2.5rem;color:var(--soft);font-size:.88rem;
border-top:1px solid var(--line)}
@media print{:root{color-scheme:light;--ground:#fff;--card:#fff;--ink:#000;--soft:#444;
--line:#bbb;--wash:#f2f2f2;--accent:#7a3a14;--series-0:#0072b2;--series-1:#d55e00;
--series-2:#009e73;--series-3:#c0639a;--series-4:#c98a00;--series-5:#3c9fd6;--series-6:#8c7500;
--series-7:#555555}
nav{display:none}header{padding-top:0}body{font-size:10.5pt}
section{margin:1.2rem 0}h2,h3{break-after:avoid}tr{break-inside:avoid}
.grid{grid-template-columns:1fr 1fr}
.compare{display:flex;gap:.4rem}.compare .bottom,.compare .top{position:relative;inset:auto;
clip-path:none;width:50%}.compare .bar,.compare input{display:none}.swap .over{position:static}.compare .top{order:-1}}
@media (prefers-reduced-motion:reduce){html{scroll-behavior:auto}}
)css";

inline constexpr char page_script[] = R"js(
for (const input of document.querySelectorAll('.compare input')) {
  const move = () => {
    input.parentElement.style.setProperty('--split', input.value + '%');
    input.setAttribute('aria-valuetext', Math.round(input.value) + ' % ' + input.dataset.left +
      ', ' + Math.round(100 - input.value) + ' % ' + input.dataset.right);
  };
  input.addEventListener('input', move);
  input.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'mouse' && event.buttons === 0) return;
    const box = input.getBoundingClientRect();
    input.value = Math.min(100, Math.max(0, 100 * (event.clientX - box.left) / box.width));
    move();
  });
  move();
}
)js";

}  // namespace drude
