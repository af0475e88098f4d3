#!/usr/bin/env python3
"""The page of a study in a real browser: STUDY-FOLDER ARTIFACT-FOLDER.

Opens STUDY-FOLDER/index.html, works its controls as a reader would, holds the read-out against the
EXRs (through oiiotool), measures contrast, and leaves screenshots and a PDF in ARTIFACT-FOLDER.
Exit status 1 where anything is not as it should be.
"""

import base64
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from chromium import Browser, browser_program

failures = []


def check(good, what):
    print(("ok      " if good else "FAILED  ") + what)
    if not good:
        failures.append(what)


def exr_pixel(path, x, y):
    """{channel: value} of one pixel."""
    with tempfile.TemporaryDirectory() as folder:
        cut = os.path.join(folder, "pixel.exr")
        subprocess.run(["oiiotool", path, "--cut", f"1x1+{x}+{y}", "-o", cut], check=True)
        text = subprocess.run(["oiiotool", "--info", "-v", "--dumpdata", cut], check=True,
                              capture_output=True, text=True).stdout
    names = re.search(r"channel list: (.*)", text).group(1).split(", ")
    values = re.search(r"Pixel \(.*?\): (.*)", text).group(1).split()
    return dict(zip(names, map(float, values)))


def number(text):
    return float(text.replace("−", "-"))


def agrees(shown, value):
    """Within a half float's rounding (2^-11) and that of the digits shown."""
    if shown == "0":
        return abs(value) < 6e-8  # below what a half float holds
    digits = 5e-3 if "e" in shown else 5e-4  # 3 or 4 of them
    return abs(number(shown) - value) <= abs(value) * (2 ** -11 + digits) + 6e-8


def box(browser, selector):
    return browser.evaluate(
        f"(() => {{const r = document.querySelector({json.dumps(selector)})"
        ".getBoundingClientRect(); return {x: r.x, y: r.y, width: r.width, height: r.height};})()")


def show(browser, selector):
    browser.evaluate(f"document.querySelector({json.dumps(selector)})"
                     ".scrollIntoView({block: 'center', behavior: 'instant'})")
    browser.settle()


def canvas_bytes(selector, expression):
    """JavaScript: `expression` of the bytes d of a canvas, read from a copy of it."""
    return (f"(() => {{const c = document.querySelector({json.dumps(selector)}); "
            "const copy = new OffscreenCanvas(c.width, c.height).getContext('2d', "
            "{willReadFrequently: true}); copy.drawImage(c, 0, 0); "
            "const d = copy.getImageData(0, 0, c.width, c.height).data; let s = 0; "
            f"for (let i = 0; i < d.length; ++i) s = {expression}; return s;}})()")


def brightness(browser, selector):
    return browser.evaluate(canvas_bytes(selector, "s + d[i]"))


def fingerprint(browser, selector):
    return browser.evaluate(canvas_bytes(selector, "(s * 31 + d[i]) % 4294967291"))


def divider(browser, metal):
    handle = f"#pair-{metal} .handle"
    split = lambda: number(browser.evaluate(
        f"document.querySelector('{handle}').getAttribute('aria-valuenow')"))
    show(browser, f"#pair-{metal} .pair")
    pane = box(browser, f"#pair-{metal} .pair")
    y = pane["y"] + 0.3 * pane["height"]
    browser.mouse("mousePressed", pane["x"] + 0.5 * pane["width"], y, "left", True, 1)
    for share in (0.45, 0.35, 0.25):
        browser.mouse("mouseMoved", pane["x"] + share * pane["width"], y, "left", True)
    browser.mouse("mouseReleased", pane["x"] + 0.25 * pane["width"], y, "left")
    check(abs(split() - 25) <= 1, f"the divider follows the mouse to 25 % (is at {split():g})")
    clip = browser.evaluate(
        f"getComputedStyle(document.querySelector('#pair-{metal} .over')).clipPath")
    check("75%" in clip, f"the upper picture is cut there ({clip})")
    browser.evaluate(f"document.querySelector('{handle}').focus()")
    browser.key("ArrowRight")
    check(abs(split() - 27) <= 1, f"an arrow key moves it (is at {split():g})")
    browser.key("End")
    check(split() == 100, "End moves it to the end")
    browser.key("Home")
    check(split() == 0, "Home moves it to the beginning")
    browser.evaluate("document.getElementById('zoom-reset').click()")
    check(split() == 50, "Reset brings it back")


def tools(browser, metals):
    show(browser, ".tools")
    over = f"#pair-{metals[0]} .over"
    dark = brightness(browser, over)
    browser.evaluate("document.getElementById('exposure').focus()")
    for _ in range(10):
        browser.key("ArrowRight")
    browser.settle()
    text = browser.evaluate("document.getElementById('exposure-value').textContent")
    check(text == "+1.0 EV", f"ten steps of the exposure are one stop ({text})")
    check(brightness(browser, over) > 1.05 * dark, "more exposure is a brighter picture")
    browser.evaluate("document.getElementById('zoom-reset').click()")
    browser.settle()
    check(brightness(browser, over) == dark, "Reset brings the picture back to the byte")

    choose = lambda name, value: browser.evaluate(
        f"(() => {{const c = document.getElementById('{name}'); c.value = '{value}';"
        "c.dispatchEvent(new Event('change'));})()")
    first_pair = f"#pair-{metals[0]}"
    state = lambda: (
        fingerprint(browser, over), fingerprint(browser, f"{first_pair} .map canvas"),
        browser.evaluate(f"document.querySelector('{first_pair} .unit').textContent"),
        browser.evaluate("document.getElementById('curve').value"),
        browser.evaluate("document.getElementById('difference').value"))
    first = state()
    choose("curve", "reinhard")
    choose("difference", "dolp")
    browser.settle()
    other = state()
    check(all(a != b for a, b in zip(first, other)), "tone curve and difference change both panes")
    browser.evaluate("document.getElementById('zoom-reset').click()")
    browser.settle()
    check(state() == first, "Reset brings tone curve and difference back")

    kinds = browser.evaluate("[...document.getElementById('difference').options]"
                             ".map((o) => o.value)")
    check(kinds == ["log", "signed", "spectral", "dolp", "aolp"], f"differences: {kinds}")
    seen = set()
    for kind in kinds:
        choose("difference", kind)
        browser.settle()
        seen.add((fingerprint(browser, f"#pair-{metals[0]} .map canvas"),
                  browser.evaluate(f"document.querySelector('#pair-{metals[0]} .unit')"
                                   ".textContent")))
    check(len(seen) == len(kinds), "each difference is a picture and a legend of its own")
    choose("difference", "log")

    prints = [fingerprint(browser, f"#pair-{m} .under") for m in metals]
    for _ in range(3):
        browser.evaluate("document.getElementById('zoom-in').click()")
    browser.settle()
    zoomed = [fingerprint(browser, f"#pair-{m} .under") for m in metals]
    check(all(a != b for a, b in zip(prints, zoomed)), "one zoom moves all pairs")
    show(browser, f"#pair-{metals[0]} .map")
    pane = box(browser, f"#pair-{metals[0]} .map")
    x, y = pane["x"] + 0.5 * pane["width"], pane["y"] + 0.5 * pane["height"]
    browser.mouse("mousePressed", x, y, "left", True, 1)
    browser.mouse("mouseMoved", x - 0.2 * pane["width"], y, "left", True)
    browser.mouse("mouseReleased", x - 0.2 * pane["width"], y, "left")
    browser.settle()
    panned = [fingerprint(browser, f"#pair-{m} .under") for m in metals]
    check(all(a != b for a, b in zip(panned, zoomed)), "dragging one map moves all pairs")
    browser.evaluate("document.getElementById('zoom-reset').click()")
    browser.settle()


def picture(folder, pair, which, spectral=False):
    """The EXR of one picture of a pair: "copper-rough", "fitted"."""
    metal = pair.removesuffix("-rough")
    finish = "-rough" if pair.endswith("-rough") else ""
    return f"{folder}/{metal}/{which}{finish}{'-spectral' if spectral else ''}.exr"


def read_out(browser, folder, metals):
    """Numbers at the cursor against the EXRs', at some places of every pair."""
    compared, wrong = 0, []
    places = [(0.5, 0.6), (0.31, 0.52), (0.72, 0.66), (0.5, 0.1)]
    for metal in metals:
        show(browser, f"#pair-{metal} .map")
        for u, v in places:
            pane = box(browser, f"#pair-{metal} .map")
            browser.mouse("mouseMoved", pane["x"] + u * pane["width"],
                          pane["y"] + v * pane["height"])
            browser.settle()
            where = browser.evaluate(f"document.querySelector('#pair-{metal} .where').textContent")
            x, y = map(int, re.search(r"Pixel (\d+), (\d+)", where).groups())
            cells = browser.evaluate(
                f"[...document.querySelectorAll('#pair-{metal} .readout tbody tr')]"
                ".map((r) => [...r.querySelectorAll('td')].map((c) => c.textContent))")
            pixels = [exr_pixel(picture(folder, metal, which), x, y)
                      for which in ("fitted", "literature")]
            for row in range(8):  # S0 fitted, S0 literature, S1 fitted, ...
                for i, shown in enumerate(cells[row]):
                    value = pixels[row % 2][f"S{row // 2}.{'RGB'[i]}"]
                    compared += 1
                    if not agrees(shown, value):
                        wrong.append(f"{metal} {x},{y} S{row // 2}: shown {shown}, EXR {value}")
            luminance = lambda p, s: sum(w * p[f"S{s}.{c}"] for w, c in
                                         zip((0.2126, 0.7152, 0.0722), "RGB"))
            for which in (0, 1):
                p = pixels[which]
                degree = math.hypot(luminance(p, 1), luminance(p, 2)) / luminance(p, 0)
                compared += 1
                shown = number(re.search(r"DoLP (\S+) %", cells[8 + which][0]).group(1)) / 100
                if abs(shown - degree) > 2e-3 * degree + 1e-6:
                    wrong.append(f"{metal} {x},{y} DoLP: shown {shown}, EXR {degree}")
    check(not wrong, f"{compared} numbers of the read-out are the EXRs' {wrong[:3]}")


def spectrum(browser, folder, metal):
    """The curve at the cursor against the spectral layers, by its own coordinates."""
    show(browser, f"#pair-{metal} .map")
    pane = box(browser, f"#pair-{metal} .map")
    browser.mouse("mouseMoved", pane["x"] + 0.6 * pane["width"], pane["y"] + 0.6 * pane["height"])
    browser.settle()
    drawing = f"#pair-{metal} .spectrum svg"
    x, y = map(int, browser.evaluate(f"document.querySelector('{drawing}').dataset.pixel")
               .split(", "))
    path = browser.evaluate(f"document.querySelector('{drawing} .line-0').getAttribute('d')")
    heights = [float(p.split()[1]) for p in re.split("[ML]", path)[1:]]
    smaller = os.path.exists(picture(folder, metal, "fitted", spectral=True))
    values = {}
    for which in ("fitted", "literature"):
        pixel = exr_pixel(picture(folder, metal, which, spectral=smaller), x, y)
        values[which] = [v for k, v in pixel.items() if k.startswith("S0.") and k.endswith("nm")]
    most = max(values["fitted"] + values["literature"])
    worst = max(abs((108 - h) / 92 - v / most) for h, v in zip(heights, values["fitted"]))
    check(len(heights) == len(values["fitted"]) and worst < 2e-3,
          f"the spectrum has the EXR's {len(heights)} values (worst {worst:.1e} of the greatest)")
    label = number(browser.evaluate(f"document.querySelector('{drawing} text').textContent"))
    check(abs(label - most) < 6e-3 * most, f"its axis ends at the greatest, {label:g}")


def cursor_keys(browser, metal):
    pane = f"#pair-{metal} .map"
    show(browser, pane)
    where = lambda: browser.evaluate(f"document.querySelector('#pair-{metal} .where').textContent")
    browser.evaluate(f"document.querySelector('{pane}').focus()")
    before = where()
    browser.key("ArrowRight")
    after = where()
    check(before != after, f"arrow keys move the cursor ({before} to {after})")
    spoken = browser.evaluate(f"document.querySelector('#pair-{metal} .spoken').textContent")
    check(after.split(" of")[0] in spoken, "and it is announced")


# Contrast after WCAG 2.1: every text against what lies behind it, and the series' colours.
CONTRAST = r"""
(() => {
  const channel = (v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const parse = (text) => (text.match(/[\d.]+/g) || []).map(Number);
  const level = (c) => 0.2126 * channel(c[0]) + 0.7152 * channel(c[1]) + 0.0722 * channel(c[2]);
  const over = (c, below) => {
    const a = c[3] === undefined ? 1 : c[3];
    return [0, 1, 2].map((i) => c[i] * a + below[i] * (1 - a));
  };
  const ratio = (a, b) => {
    const x = level(a), y = level(b);
    return (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05);
  };
  const behind = (element) => {
    const layers = [];
    for (let e = element; e; e = e.parentElement) {
      layers.push(parse(getComputedStyle(e).backgroundColor));
    }
    return layers.reverse().reduce((below, c) => c.length ? over(c, below) : below,
      matchMedia('(prefers-color-scheme: dark)').matches ? [18, 18, 18] : [255, 255, 255]);
  };
  const seen = new Map();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node; (node = walker.nextNode());) {
    const e = node.parentElement;
    if (!node.textContent.trim() || e.closest('script,style,title,desc,.spoken')) continue;
    const style = getComputedStyle(e), r = e.getBoundingClientRect();
    if (r.width === 0 || style.visibility === 'hidden' || e.closest('.pane')) continue;
    const inSvg = e.closest('svg');
    const ink = parse(inSvg ? style.fill : style.color);
    const paper = behind(e), opacity = inSvg ? +style.opacity : 1;
    const c = over([ink[0], ink[1], ink[2], (ink[3] === undefined ? 1 : ink[3]) * opacity], paper);
    const size = parseFloat(style.fontSize);
    const needed = size >= 24 || (size >= 18.66 && +style.fontWeight >= 700) ? 3 : 4.5;
    const got = ratio(c, paper);
    if (got < needed) seen.set(`${e.tagName}.${e.className.baseVal ?? e.className} ` +
      `"${node.textContent.trim().slice(0, 24)}"`, got.toFixed(2));
  }
  const card = document.createElement('figure');
  document.body.append(card);
  const ground = behind(card);
  for (let i = 0; i < 8; ++i) {
    card.style.color = `var(--series-${i})`;
    const got = ratio(parse(getComputedStyle(card).color), ground);
    if (got < 3) seen.set(`series ${i}`, got.toFixed(2));
  }
  card.remove();
  return [...seen].map(([what, got]) => `${what} ${got}`);
})()
"""

# The same of a figure's file: its text and its series on its ground.
SVG_CONTRAST = r"""
(() => {
  const channel = (v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const level = (text) => {
    const c = text.match(/[\d.]+/g).map(Number);
    return 0.2126 * channel(c[0]) + 0.7152 * channel(c[1]) + 0.0722 * channel(c[2]);
  };
  const ground = level(getComputedStyle(document.querySelector('.sheet')).fill);
  const ratio = (paint) => {
    const ink = level(paint);
    return (Math.max(ink, ground) + 0.05) / (Math.min(ink, ground) + 0.05);
  };
  const low = [];
  for (const t of document.querySelectorAll('text')) {
    const got = ratio(getComputedStyle(t).fill);
    if (got < 4.5) low.push(`${t.textContent} ${got.toFixed(2)}`);
  }
  for (const e of document.querySelectorAll('[style]')) {
    for (const paint of ['stroke', 'fill']) {
      if (!e.style[paint]) continue;
      const got = ratio(getComputedStyle(e)[paint]);
      if (got < 3) low.push(`${e.tagName} ${got.toFixed(2)}`);
    }
  }
  return [...new Set(low)];
})()
"""

NAMES = r"""
(() => {
  const bad = [];
  const named = (e) => e.getAttribute('aria-label') || e.getAttribute('aria-labelledby') ||
    e.getAttribute('alt') || e.textContent.trim() || (e.labels && e.labels.length);
  for (const e of document.querySelectorAll('img,svg,canvas,button,select,input,[role=slider],nav,' +
      '[tabindex]')) {
    if (!named(e)) bad.push(e.outerHTML.slice(0, 80));
  }
  const ids = [...document.querySelectorAll('[id]')].map((e) => e.id);
  if (new Set(ids).size !== ids.length) bad.push('ids twice: ' +
    ids.filter((id, i) => ids.indexOf(id) !== i).slice(0, 3));
  let last = 0;
  for (const h of document.querySelectorAll('h1,h2,h3,h4')) {
    const level = +h.tagName[1];
    if (level > last + 1) bad.push(`heading level ${last} to ${level}: ${h.textContent}`);
    last = level;
  }
  for (const e of document.querySelectorAll('[aria-labelledby]')) {
    for (const id of e.getAttribute('aria-labelledby').split(' ')) {
      if (!document.getElementById(id)) bad.push('label missing: ' + id);
    }
  }
  if (!document.documentElement.lang) bad.push('no language');
  return bad;
})()
"""


def look(browser, artifacts):
    """Screenshots at five widths, light and dark, with contrast measured in each."""
    for scheme in ("light", "dark"):
        browser.prefer(scheme)
        for width in (320, 400, 700, 900, 1600):
            browser.resize(width)
            browser.settle()
            browser.settle()
            wide = browser.evaluate("document.documentElement.scrollWidth")
            check(wide <= width, f"{scheme} {width}: nothing sticks out ({wide} pixels)")
            narrow = browser.evaluate(
                "[...document.querySelectorAll('.readout td')].filter((e) => "
                "e.scrollWidth > e.clientWidth).map((e) => e.textContent)")
            check(not narrow, f"{scheme} {width}: no number runs out of its cell {narrow[:3]}")
            low = browser.evaluate(CONTRAST)
            check(not low, f"{scheme} {width}: contrast {low[:4]}")
            browser.screenshot(artifacts / f"page-{scheme}-{width}.png")
            browser.screenshot(artifacts / f"pictures-{scheme}-{width}.png", "#pictures")
    browser.prefer("light")
    browser.resize(1600)
    browser.settle()


def print_pdf(browser, artifacts):
    pdf = base64.b64decode(browser.send("Page.printToPDF", printBackground=True,
                                        preferCSSPageSize=True)["data"])
    (artifacts / "page.pdf").write_bytes(pdf)
    pages = len(re.findall(rb"/Type\s*/Page\b", pdf))
    check(pdf.startswith(b"%PDF") and 5 <= pages <= 60, f"prints to {pages} pages of PDF")


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, artifacts = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    artifacts.mkdir(parents=True, exist_ok=True)
    program = browser_program()
    if not program:
        sys.exit("no Chromium found; install it, or name it in CHROMIUM")
    metals = []  # pairs, in the page's order
    for metal in json.loads((folder / "study.json").read_text())["metals"]:
        metals.append(metal["folder"])
        if "lobe" in metal:
            metals.append(metal["folder"] + "-rough")
    page = folder / "index.html"
    size = page.stat().st_size / 1e6
    check(size < 15, f"the page has {size:.1f} MB")
    with Browser(program) as browser:
        browser.open(page.as_uri())
        browser.wait_for("document.body.classList.contains('viewer-ready')", "the pictures")
        divider(browser, metals[0])
        tools(browser, metals)
        read_out(browser, folder, metals)
        spectrum(browser, folder, metals[1])
        cursor_keys(browser, metals[0])
        wrong = browser.evaluate(NAMES)
        check(not wrong, f"everything has a name and headings are in order {wrong[:4]}")
        look(browser, artifacts)
        print_pdf(browser, artifacts)
        check(not browser.problems(), f"no errors, nothing fetched {browser.problems()[:3]}")
    for figure in (5, 6, 7, 8):
        with Browser(program) as browser:
            svg = folder / f"figure-{figure}.svg"
            browser.open(svg.as_uri(), 1800, 1000)
            title = browser.evaluate("document.documentElement.tagName === 'svg' && "
                                     "document.querySelector('title').textContent")
            check(bool(title) and f"Figure {figure}" in title, f"{svg.name}: {title}")
            for scheme in ("dark", "light"):
                browser.prefer(scheme)
                browser.settle()
                low = browser.evaluate(SVG_CONTRAST)
                check(not low, f"{svg.name} {scheme}: contrast {low[:4]}")
            check(not browser.problems(), f"{svg.name}: no errors {browser.problems()[:3]}")
            shot = browser.send("Page.captureScreenshot", format="png")
            (artifacts / f"figure-{figure}.png").write_bytes(base64.b64decode(shot["data"]))
    if failures:
        sys.exit(f"{len(failures)} of the checks failed")


main()
