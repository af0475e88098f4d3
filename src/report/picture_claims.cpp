// The claims of section 4.4, about the rendered pairs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/claim_figures.h"
#include "report/claims.h"

namespace drude {

std::vector<Claim> picture_claims(const Study& study) {
    Claim gold{
        "picture-gold",      "4.4", "Of the five pairs of pictures, gold's differs least.", "",
        Verdict::not_tested, ""};
    Claim most{"picture-most",      "4.4", "Aluminium's and silver's differ most.", "",
               Verdict::not_tested, ""};
    Claim subtle{"picture-subtle",    "4.4", "All differences remain subtle.", "",
                 Verdict::not_tested, ""};
    std::vector<const StudyMetal*> order;
    for (const StudyMetal& metal : study.metals) {
        if (metal.pair && metal.pair->pixels > 0) order.push_back(&metal);
    }
    if (order.size() < 3 || order.size() != study.metals.size()) return {gold, most, subtle};
    std::sort(order.begin(), order.end(), [](const StudyMetal* a, const StudyMetal* b) {
        return a->pair->mean_absolute < b->pair->mean_absolute;
    });
    std::vector<std::string> by_difference, by_eye;
    bool all_below = true, some_below = false;
    for (const StudyMetal* metal : order) {
        const PairStatistics& s = *metal->pair;
        by_difference.push_back(fmt::format("{} {:.4f}", metal->name, s.mean_absolute));
        by_eye.push_back(fmt::format("{} ΔE {:.1f} ({} of its pixels noticeable)", metal->name,
                                     s.mean_delta_e, percent_text(s.noticeable)));
        all_below = all_below && s.mean_delta_e < 2.3;
        some_below = some_below || s.mean_delta_e < 2.3;
    }
    gold.finding = fmt::format("Mean absolute difference of linear R, G, B on the metal: {}.",
                               fmt::join(by_difference, " < "));
    const auto rank = [&](const char* folder) {
        return std::find_if(order.begin(), order.end(),
                            [&](const StudyMetal* m) { return m->folder == folder; }) -
               order.begin();
    };
    const auto last = static_cast<std::ptrdiff_t>(order.size()) - 1;
    gold.verdict = rank("gold") == 0   ? Verdict::holds
                   : rank("gold") == 1 ? Verdict::partly
                                       : Verdict::does_not_hold;
    gold.why =
        "Holds where gold comes first, partly second. The order is that of how far the two "
        "publications of each metal are apart: with other pairs of sets it changes.";
    const bool al = rank("aluminium") >= last - 1, ag = rank("silver") >= last - 1;
    most.finding = fmt::format("Largest: {}; then {}.", order[order.size() - 1]->name,
                               order[order.size() - 2]->name);
    most.verdict = al && ag ? Verdict::holds : al || ag ? Verdict::partly : Verdict::does_not_hold;
    most.why =
        "Holds where these two come last, partly where one of them does. They reflect most, so "
        "that the same relative difference is a larger absolute one; the rest is again the choice "
        "of sets.";
    subtle.finding =
        fmt::format("Mean colour difference, pictures exposed alike: {}.", fmt::join(by_eye, "; "));
    subtle.verdict = all_below    ? Verdict::holds
                     : some_below ? Verdict::partly
                                  : Verdict::does_not_hold;
    subtle.why =
        "Subtle: a mean ΔE*ab below 2.3, which is just noticeable side by side (Mahy et al. 1994). "
        "Pictures looked at one after the other hide more than that.";
    return {gold, most, subtle};
}

}  // namespace drude
