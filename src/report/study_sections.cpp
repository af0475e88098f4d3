// The sections of a study's page that are about pictures, the paper, and how it was all made.
#include "report/study_sections.h"

#include <fmt/format.h>

#include <cmath>

#include "report/markup.h"
#include "report/table_1.h"
#include "report/viewer.h"
#include "report/web.h"

namespace drude {

namespace {

// A duration as people say it.
std::string duration(double seconds) {
    if (!(seconds >= 0)) return "–";
    if (seconds < 90) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long long>(std::llround(seconds));
    return fmt::format("{} min {} s", whole / 60, whole % 60);
}

// "Copper, rough (blinn-phong, β = 0.1200)".
std::string rough_name(const StudyMetal& metal) {
    const Material& surface = metal.lobe->surface;
    return fmt::format("{}, rough ({}, β = {:.4f})", metal.name, lobe_name(surface.lobe),
                       surface.beta);
}

std::string roughness(const StudyInfo& info) {
    return fmt::format("{} lobe, {} masking, β = {:.6g} rad", info.lobe, info.masking, info.beta);
}

// A sign before the word, so that the verdict does not hang on its colour.
std::string verdict_mark(Verdict verdict) {
    switch (verdict) {
        case Verdict::holds:
            return "✓";
        case Verdict::partly:
            return "◐";
        case Verdict::does_not_hold:
            return "✗";
        case Verdict::not_tested:
            break;
    }
    return "–";
}

std::string verdict_element(Verdict verdict) {
    const std::string text = verdict_text(verdict);
    return fmt::format("<span class=\"verdict {}\"><span aria-hidden=\"true\">{}</span> {}</span>",
                       identifier(text), verdict_mark(verdict), text);
}

std::string tally(const std::vector<Claim>& claims) {
    std::string text;
    for (const Verdict v :
         {Verdict::holds, Verdict::partly, Verdict::does_not_hold, Verdict::not_tested}) {
        int count = 0;
        for (const Claim& claim : claims) count += claim.verdict == v;
        text += fmt::format("<li>{} <b>{}</b></li>", verdict_element(v), count);
    }
    return text;
}

}  // namespace

void section_question(Page& page, const Study& study, const StudyPage& content) {
    page.section("The question", "question");
    page.paragraph(
        "Renderers compute metals from n and k of a handbook. Berger, Weidlich, Wilkie & Magnor "
        "measured real samples with an ellipsometer, which sees polarisation and needs no "
        "absolute reflectance, fitted n and k, and asked: do the physically based models describe "
        "these surfaces, and does it show in a picture whether n and k were measured or looked "
        "up?");
    page.paragraph(
        "This page goes round the same loop with everything written down: a bench that captures "
        "raw "
        "frames, the measurement reduced from them, a fit, two pairs of pictures a metal, their "
        "differences, and what of the paper's statements that bears out.");
    if (!content.claims.empty())
        page.markup(fmt::format(
            "<p>Of {} statements of the paper (<a href=\"#claims\">each with its numbers</a>):</p>"
            "\n<ul class=\"tally\">{}</ul>\n",
            content.claims.size(), tally(content.claims)));
    if (!content.sheet_png.empty())
        page.picture(
            {content.sheet_png,
             "Sheet of rendered half-spheres, one column a metal: fitted constants above, "
             "literature in the middle, their log-scaled difference below."},
            "As figure 9 of the paper. Above: rendered with the constants fitted to what the "
            "virtual bench captured. Middle: with the literature's. Below: log10 of the absolute "
            "difference, "
            "taken on linear radiance before tone mapping; both pictures of a pair share one tone "
            "curve (Durand & Dorsey 2002)." +
                (study.info.environment_credit.empty()
                     ? ""
                     : " " + study.info.environment_credit + "."));
}

void section_table_1(Page& page, const Study& study) {
    page.section("Table 1, the paper's and ours", "table-1");
    page.paragraph(
        "The paper fitted |ρ|² = tan²Ψ at one wavelength and all angles, from literature values: "
        "the ratio of the Fresnel terms, then the ratio under four facet distributions with β as a "
        "third unknown. Ours is the same procedure with the study's captured measurement; the "
        "last line of each table is the fit to Ψ and Δ together.");
    const std::vector<Table1Metal> metals = table_1(study);
    page.note(table_1_note(metals));
    page.markup(table_1_markup(metals));
    page.code("drude fit --like-the-paper");
}

void section_pictures(Page& page, const Study& study, const StudyPage& content) {
    page.section("The pictures, pair by pair", "pictures");
    page.paragraph(
        "Half-spheres in one environment, one seed for both of a pair, so that the difference is "
        "the metals' alone. Each metal has two pairs: nearly polished, with one roughness for all "
        "metals, as in the paper, and with the lobe and β that its lobe scan says. Drag the "
        "divider, or focus it and use the arrow keys. The cursor, the "
        "zoom (double click, Ctrl and wheel, or + and −) and the exposure are common to all pairs: "
        "what is read out on one metal is read out on every other at the same place.");
    PageTable table;
    table.caption =
        "Over the pixels that differ: log10 of the mean |fitted − literature| of linear R, G, B "
        "(its mean, median, 99th percentile and greatest value), and how the eye would judge it: "
        "mean ΔE*ab with both pictures exposed alike, and the share of pixels beyond a just "
        "noticeable 2.3.";
    table.columns = {"Metal", "Mean", "Median", "99 %", "Greatest", "Mean ΔE", "Noticeable"};
    table.numeric = {false, true, true, true, true, true, true};
    const auto add = [&](const std::string& name, const std::optional<PairStatistics>& pair) {
        if (!pair) return;
        const Log10Difference& d = pair->log10;
        table.rows.push_back({name, number_text(d.mean, 2), number_text(d.p50, 2),
                              number_text(d.p99, 2), number_text(d.max, 2),
                              number_text(pair->mean_delta_e, 2),
                              number_text(100 * pair->noticeable, 1) + " %"});
    };
    std::vector<ViewedPair> pairs;
    for (const StudyMetal& m : study.metals) {
        add(m.name, m.pair);
        pairs.push_back({pair_id(m, Finish::smooth), m.name, m.literature_set});
        if (!m.lobe) continue;
        add(rough_name(m), m.lobe->pair);
        pairs.push_back({pair_id(m, Finish::rough), rough_name(m), m.literature_set});
    }
    if (!content.picture_data.empty()) {
        page.markup(viewer_markup(pairs, content.picture_data));
        page.style(web_style("viewer"));
        page.script(viewer_script());
        const std::string& credit = study.info.environment_credit;
        page.paragraph(content.data_description + (credit.empty() ? "" : " " + credit + "."));
    }
    if (!table.rows.empty()) page.table(table);
}

void section_claims(Page& page, const StudyPage& content) {
    if (content.claims.empty()) return;
    page.section("What the paper says, and what we find", "claims");
    page.paragraph(
        "Statements of the paper in our words, against the numbers of this study. Every verdict is "
        "computed by the rule that stands beside it; none is about the paper's own samples, which "
        "nobody here has.");
    // Roles are spelled out: a narrow screen lays the cells out as blocks, and a browser then
    // forgets that they were a table.
    std::string table =
        "<table class=\"claims\" role=\"table\" aria-label=\"Claims of the paper\"><thead "
        "role=\"rowgroup\"><tr role=\"row\"><th role=\"columnheader\">Claim</th>"
        "<th role=\"columnheader\">Here</th><th role=\"columnheader\">What we find</th>"
        "<th role=\"columnheader\">Rule and reason</th></tr></thead>\n<tbody role=\"rowgroup\">\n";
    for (const Claim& claim : content.claims) {
        table += fmt::format(
            "<tr role=\"row\" id=\"claim-{}\"><th role=\"rowheader\">{} <small>§ {}</small></th>"
            "<td role=\"cell\">{}</td><td role=\"cell\">{}</td><td role=\"cell\">{}</td></tr>\n",
            identifier(claim.id), escape_markup(claim.claim), escape_markup(claim.section),
            verdict_element(claim.verdict), escape_markup(claim.finding), escape_markup(claim.why));
    }
    page.markup(table + "</tbody></table>\n");
}

void section_figures(Page& page, const StudyPage& content) {
    if (content.figures.empty()) return;
    page.section("The paper's figures", "figures");
    for (const PaperFigure& figure : content.figures) {
        page.heading(figure.title);
        page.paragraph(figure.caption);
        for (const auto& row : figure.rows) {
            page.begin_grid();
            for (const FigurePanel& panel : row) page.svg(panel.svg, panel.caption);
            page.end_grid();
        }
        page.code(fmt::format("drude report {} --figure {}", content.folder, figure.number));
    }
    page.heading("Figure 9: the pictures");
    page.paragraph("The sheet at the head of this page; at full size it is comparison.png.");
    page.code(fmt::format("drude report {} --figure {}", content.folder, picture_figure));
}

void section_sources(Page& page, const Study& study, const StudyPage& content) {
    page.section("Sources", "sources");
    PageTable sets;
    sets.caption = "Every published set drawn above, with its range and its original publication.";
    sets.columns = {"Set", "Kind", "Range (nm)", "Publication"};
    sets.numeric = {false, false, true, false};
    for (const StudyMetal& metal : study.metals)
        for (const OpticalConstants& set : metal.published)
            sets.rows.push_back({set.name, set.kind,
                                 set.wavelength_nm.empty()
                                     ? "–"
                                     : fmt::format("{:g}–{:g}", set.first_nm(), set.last_nm()),
                                 set.citation});
    page.table(sets);
    page.section("How it was made", "provenance");
    const StudyInfo& info = study.info;
    std::vector<std::pair<std::string, std::string>> facts = {
        {"Program", "drude " + info.version},
        {"Environment", info.environment},
        {"Surface of the polished pairs", roughness(info)},
        {"Samples a pixel", fmt::format("{}, seed {}", info.samples_per_pixel, info.seed)},
        {"Estimator", info.estimator},
        {"Wall time", fmt::format("{}, of which {} rendering", duration(info.seconds),
                                  duration(info.render_seconds))}};
    if (!info.environment_credit.empty())
        facts.insert(facts.begin() + 2, {"Credit", info.environment_credit});
    page.facts(facts);
    if (!info.command_line.empty()) page.code(info.command_line);
    if (!content.folder.empty()) {
        page.paragraph("This page and its figures alone, without rendering:");
        page.code("drude report " + content.folder);
    }
}

}  // namespace drude
