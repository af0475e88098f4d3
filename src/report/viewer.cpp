#include "report/viewer.h"

#include <fmt/format.h>

#include "report/markup.h"
#include "report/web.h"

namespace drude {

namespace {

constexpr const char* tools = R"html(<div class="tools" role="group" aria-label="View of all pairs">
<label for="exposure">Exposure <input type="range" id="exposure" min="-6" max="6" step="0.1" value="0"></label>
<output id="exposure-value" for="exposure">0.0 EV</output>
<label for="curve">Tone curve <select id="curve"><option value="srgb">sRGB, clipped</option><option value="reinhard">Reinhard</option></select></label>
<label for="difference">Difference <select id="difference"><option value="log">log10 |fitted − literature|</option><option value="signed">signed</option><option value="spectral">spectral</option><option value="dolp">degree of polarisation</option><option value="aolp">angle of polarisation</option></select></label>
<span class="group" role="group" aria-label="Zoom"><button type="button" id="zoom-out" aria-label="Zoom out">−</button><output id="zoom-value">1.0×</output><button type="button" id="zoom-in" aria-label="Zoom in">+</button><button type="button" id="zoom-reset">Reset</button></span>
</div>
)html";

std::string figure(const ViewedPair& pair) {
    const std::string name = escape_markup(pair.name);
    const std::string literature = escape_markup(pair.literature_set);
    return fmt::format(
        R"html(<figure class="viewer" id="pair-{0}" data-pair="{0}">
<h3>{1}</h3>
<div class="panes">
<div class="pane pair" tabindex="0" role="group" aria-label="{1}, fitted left of the divider, {2} right of it. Arrow keys move the cursor, plus and minus zoom, 0 shows all.">
<canvas class="under" role="img" aria-label="{1}: half-sphere with n, k of {2}"></canvas>
<canvas class="over" role="img" aria-label="{1}: half-sphere with the fitted n, k"></canvas>
<span class="tag left">fitted</span><span class="tag right">{2}</span>
<div class="handle" role="slider" tabindex="0" aria-label="Divider of {1}" aria-orientation="horizontal" aria-valuemin="0" aria-valuemax="100" aria-valuenow="50"></div>
</div>
<div><div class="pane map" tabindex="0" role="group" aria-label="{1}, difference of the pair. Arrow keys move the cursor, plus and minus zoom, 0 shows all."><canvas role="img" aria-label="Difference of the two pictures of {1}"></canvas></div>
<div class="ramp" aria-hidden="true"></div><div class="scale"><span></span><span></span><span></span></div><p class="unit"></p></div>
<div class="readout">
<p class="where">Unpacking the numbers …</p>
<table aria-label="Stokes parameters of {1} at the cursor"><thead>
<tr><td></td><td></td><th scope="col">R</th><th scope="col">G</th><th scope="col">B</th></tr>
</thead><tbody></tbody></table>
<div class="spectrum"></div><p class="spoken" aria-live="polite"></p>
</div>
</div>
</figure>
)html",
        pair.id, name, literature);
}

}  // namespace

std::string pair_id(const StudyMetal& metal, Finish finish) {
    return identifier(metal.folder) + (finish == Finish::rough ? "-rough" : "");
}

std::string viewer_markup(const std::vector<ViewedPair>& pairs, const std::string& picture_data) {
    std::string markup = tools;
    for (const ViewedPair& pair : pairs) markup += figure(pair);
    return markup + "<script type=\"application/json\" id=\"picture-data\">" + picture_data +
           "</script>\n";
}

std::string viewer_script() {
    std::string script = "(() => {\n'use strict';\n";
    for (const char* part : {"viewer_layers", "viewer_paint", "viewer_readout", "viewer"}) {
        script += web_script(part);
    }
    return script + "})();\n";
}

}  // namespace drude
