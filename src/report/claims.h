// What Berger, Weidlich, Wilkie & Magnor (2012) say in words, held against a study's numbers.
//
// No verdict is written down anywhere: each follows from figures of the study by a rule that stands
// beside it in the text of the finding.
#pragma once

#include <string>
#include <vector>

#include "report/study_data.h"

namespace drude {

enum class Verdict { holds, partly, does_not_hold, not_tested };
// "holds", "partly", "does not hold", "not tested".
std::string verdict_text(Verdict verdict);

struct Claim {
    std::string id;       // "copper-k-below": stable, for scripts
    std::string section;  // of the paper: "4.1"
    std::string claim;    // in our words
    std::string finding;  // numbers
    Verdict verdict = Verdict::not_tested;
    std::string why;  // rule and reason
};

// In the order of the paper. What a study lacks (no film, no pictures) is "not tested".
std::vector<Claim> paper_claims(const Study& study);

// Those of them that are about the anodised surface, and about the rendered pairs.
std::vector<Claim> film_claims(const Study& study);
std::vector<Claim> picture_claims(const Study& study);

}  // namespace drude
