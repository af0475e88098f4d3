#include "report/table_1.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "base/error.h"
#include "report/markup.h"

namespace drude {

namespace {

constexpr double moved_by = 1e-3;  // a smaller step of beta is none

std::string cell_class(bool hatched) {
    return hatched ? "number nothing" : "number";
}

std::string cell(double value, int decimals, bool hatched) {
    return fmt::format(
        "<td class=\"{}\">{}</td>", cell_class(hatched),
        std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : std::string("–"));
}

const std::string empty_cell = "<td class=\"number\">–</td>";

bool says_nothing(double value, double sigma) {
    return sigma > largest_relative_sigma * std::abs(value);
}

bool beta_says_nothing(const PaperFitBlock& block) {
    return block.column_beta < least_column_beta;
}

// Where beta ended, from every start: "= start", or "0.2 → 0.31, 0.5 → 0.64".
std::string trips(const PaperFitBlock& block) {
    std::string text;
    bool moved = false;
    for (size_t i = 0; i < block.beta_end.size(); ++i) {
        moved = moved || std::abs(block.beta_end[i] - block.beta_start[i]) > moved_by;
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
        const PaperFit& check = metal.check.fit;
        const PaperFit& fit = metal.fit;
        const bool ours = i < fit.blocks.size();
        const bool beta = !std::isnan(printed.beta);
        const auto our_cell = [&](double value, double sigma) {
            return cell(value, 4, says_nothing(value, sigma));
        };
        rows += "<tr><th scope=\"row\">" + escape_markup(names[i]) + "</th>" +
                cell(printed.n, 3, says_nothing(printed.n, check.sigma_n)) +
                (ours ? our_cell(fit.blocks[i].n, fit.sigma_n) : empty_cell) +
                cell(printed.k, 3, says_nothing(printed.k, check.sigma_k)) +
                (ours ? our_cell(fit.blocks[i].k, fit.sigma_k) : empty_cell) +
                (beta ? cell(printed.beta, 3, beta_says_nothing(check.blocks[i])) : empty_cell) +
                (ours && beta ? fmt::format("<td class=\"{}\">{}</td>",
                                            cell_class(beta_says_nothing(fit.blocks[i])),
                                            escape_markup(trips(fit.blocks[i])))
                              : empty_cell) +
                "</tr>\n";
    }
    const FittedPoint& point = metal.fit.psi_delta;
    if (!metal.fit.blocks.empty() && point.identifiable)
        rows += fmt::format(
            "<tr class=\"ours\"><th scope=\"row\">Ψ and Δ, ours</th>"
            "<td class=\"{}\" colspan=\"2\">{:.4f} ± {:.4f}</td>"
            "<td class=\"{}\" colspan=\"2\">{:.4f} ± {:.4f}</td>"
            "<td class=\"number\" colspan=\"2\">not in Ψ, Δ</td></tr>\n",
            cell_class(says_nothing(point.n, point.sigma_n)), point.n, point.sigma_n,
            cell_class(says_nothing(point.k, point.sigma_k)), point.k, point.sigma_k);
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
                // From the set the study compares with: the paper's own choice for the metal may
                // be what the sample is made of, and the fit would start from its truth.
                LikeThePaperOptions paper;
                paper.literature = ours.literature;
                metal.fit = fit_like_the_paper(ours.measurement, paper);
            } catch (const Error& error) {
                metal.refusal = error.message();
            }
        }
        metals.push_back(std::move(metal));
    }
    return metals;
}

std::string table_1_note(const std::vector<Table1Metal>& metals) {
    double column = 0, moved = 0, apart = 0;
    std::set<double> starts;
    for (const Table1Metal& metal : metals) {
        for (const PaperFit* fit : {&metal.check.fit, &metal.fit}) {
            for (const PaperFitBlock& block : fit->blocks) {
                const PaperFitBlock& first = fit->blocks.front();
                apart = std::max({apart, std::abs(block.n - first.n), std::abs(block.k - first.k)});
                for (size_t i = 0; i < block.beta_start.size(); ++i) {
                    column = std::max(column, block.column_beta);
                    moved = std::max(moved, std::abs(block.beta_end[i] - block.beta_start[i]));
                    starts.insert(block.beta_start[i]);
                }
            }
        }
    }
    std::string text = fmt::format(
        "Hatched numbers hold no information: β where |ρ|² changes by less than {:g} a unit of it, "
        "n and k where one standard deviation is more than {:g} % of the value (the paper's: by a "
        "fit to the printed pair, at 0.05°).",
        least_column_beta, 100 * largest_relative_sigma);
    if (starts.empty()) return text;
    if (column < least_column_beta) {
        text +=
            " In the mirror direction the facet distribution and the masking multiply r_p and r_s "
            "alike and cancel in their ratio.";
    }
    text += fmt::format(
        " Here |ρ|² changes by up to {:.2g} a unit of β, and n and k of the distributions are up "
        "to {:.2g} from those of the Fresnel terms; β, started from {}, ",
        column, apart, fmt::join(starts, " and from "));
    text += moved > moved_by ? fmt::format("ends up to {:.2g} away from there.", moved)
                             : std::string("ends where it was started (= start).");
    return text + " A scan of the lobe holds β (drude fit --lobe-scan).";
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
