#include "report/table_1.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "base/error.h"
#include "report/markup.h"

namespace drude {

namespace {

constexpr const char* nothing = "<td class=\"number nothing\">{}</td>";

std::string cell(double value, int decimals) {
    if (!std::isfinite(value)) return "<td class=\"number\">–</td>";
    return fmt::format("<td class=\"number\">{:.{}f}</td>", value, decimals);
}

std::string no_information(double value, int decimals) {
    return fmt::format(fmt::runtime(nothing), std::isfinite(value)
                                                  ? fmt::format("{:.{}f}", value, decimals)
                                                  : std::string("–"));
}

// Where beta ended, from every start: "= start", or "0.2 → 0.31, 0.5 → 0.64".
std::string trips(const PaperFitBlock& block) {
    std::string text;
    bool moved = false;
    for (size_t i = 0; i < block.beta_end.size(); ++i) {
        moved = moved || std::abs(block.beta_end[i] - block.beta_start[i]) > 1e-3;
        text +=
            fmt::format("{}{:g} → {:.3g}", i ? ", " : "", block.beta_start[i], block.beta_end[i]);
    }
    return moved ? text : "= start";
}

std::string rows_of(const Table1Metal& metal) {
    const std::vector<std::string>& names = paper_block_names();
    std::string rows;
    for (size_t i = 0; i < names.size(); ++i) {
        const PaperValues& printed = metal.printed->blocks[i];
        const bool ours = i < metal.fit.blocks.size();
        const bool beta = !std::isnan(printed.beta);
        rows += "<tr><th scope=\"row\">" + escape_markup(names[i]) + "</th>" + cell(printed.n, 3) +
                (ours ? cell(metal.fit.blocks[i].n, 4) : cell(std::nan(""), 0)) +
                cell(printed.k, 3) +
                (ours ? cell(metal.fit.blocks[i].k, 4) : cell(std::nan(""), 0)) +
                (beta ? no_information(printed.beta, 3) : cell(std::nan(""), 0)) +
                (ours && beta
                     ? fmt::format(fmt::runtime(nothing), escape_markup(trips(metal.fit.blocks[i])))
                     : cell(std::nan(""), 0)) +
                "</tr>\n";
    }
    const FittedPoint& point = metal.fit.psi_delta;
    if (!metal.fit.blocks.empty() && point.identifiable)
        rows += fmt::format(
            "<tr class=\"ours\"><th scope=\"row\">Ψ and Δ, ours</th>"
            "<td class=\"number\" colspan=\"2\">{:.4f} ± {:.4f}</td>"
            "<td class=\"number\" colspan=\"2\">{:.4f} ± {:.4f}</td>"
            "<td class=\"number\" colspan=\"2\">not in Ψ, Δ</td></tr>\n",
            point.n, point.sigma_n, point.k, point.sigma_k);
    return rows;
}

std::string remarks(const Table1Metal& metal) {
    std::string text;
    if (metal.fit.blocks.empty()) {
        text = metal.refusal.empty() ? "The study has no such sample: printed values only."
                                     : "Ours was refused: " + metal.refusal + ".";
    } else {
        const PaperFitBlock& block = metal.fit.blocks.back();
        text = fmt::format(
            "Ours: {} at {:g} nm, started from {}; |ρ|² alone gives n within {:.2g} and k within "
            "{:.2g} (1σ). Change of |ρ|² per unit of n, k, β: {:.2g}, {:.2g}, {:.1g}.",
            metal.sample, metal.fit.wavelength_nm, metal.fit.literature, metal.fit.sigma_n,
            metal.fit.sigma_k, block.column_n, block.column_k, block.column_beta);
    }
    const PaperCheck& check = metal.check;
    text += fmt::format(
        " The printed pair, put into |ρ|² and fitted, comes back within {:.1e}; the five printed "
        "pairs, which should be one, lie up to {:.2f}° apart in Ψ",
        check.largest_error, check.largest_psi_difference_deg);
    text += check.largest_psi_difference_deg > 0.05
                ? fmt::format(" ({}): more than the instrument's 0.05°.", check.largest_at)
                : std::string(".");
    if (check.beta_repeated)
        text +=
            " β is printed alike for Blinn-Phong and Beckmann, where it means different things.";
    return text;
}

}  // namespace

std::vector<Table1Metal> table_1(const Study& study) {
    std::vector<Table1Metal> metals;
    for (PaperCheck& check : check_paper_table()) {
        Table1Metal metal;
        metal.printed = check.metal;
        metal.name = check.metal->name;
        metal.name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(metal.name[0])));
        metal.check = std::move(check);
        for (const StudyMetal& ours : study.metals) {
            if (paper_metal_of(ours.sample_set) != metal.printed) continue;
            metal.sample = fmt::format("{} ({})", ours.name, ours.sample_set);
            try {
                metal.fit = fit_like_the_paper(ours.measurement, {});
            } catch (const Error& error) {
                metal.refusal = error.message();
            }
        }
        metals.push_back(std::move(metal));
    }
    return metals;
}

std::string table_1_markup(const std::vector<Table1Metal>& metals) {
    std::string html = "<div class=\"grid table-1\">\n";
    for (const Table1Metal& metal : metals) {
        const std::string name = escape_markup(metal.name);
        html += fmt::format(
            "<figure><div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"Table 1, "
            "{0}\"><table><caption>{0}, {1:g} nm</caption><thead><tr><td></td>"
            "<th scope=\"colgroup\" colspan=\"2\">n</th><th scope=\"colgroup\" "
            "colspan=\"2\">k</th><th scope=\"colgroup\" colspan=\"2\">β</th></tr><tr><td></td>",
            name, metal.printed->wavelength_nm);
        for (int i = 0; i < 3; ++i)
            html +=
                "<th scope=\"col\" class=\"number\">paper</th>"
                "<th scope=\"col\" class=\"number\">ours</th>";
        html += "</tr></thead>\n<tbody>" + rows_of(metal) + "</tbody></table></div><figcaption>" +
                escape_markup(remarks(metal)) + "</figcaption></figure>\n";
    }
    return html + "</div>\n";
}

}  // namespace drude
