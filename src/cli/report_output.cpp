#include "cli/report_output.h"

#include <fmt/format.h>

namespace drude {

nlohmann::ordered_json report_json(const std::string& folder, const ReportResult& result) {
    nlohmann::ordered_json json = {{"folder", folder},
                                   {"files", result.files},
                                   {"page_bytes", result.page_bytes},
                                   {"embedded", result.data_description},
                                   {"claims", nlohmann::ordered_json::array()}};
    for (const Claim& claim : result.claims) {
        json["claims"].push_back({{"id", claim.id},
                                  {"section", claim.section},
                                  {"claim", claim.claim},
                                  {"finding", claim.finding},
                                  {"verdict", verdict_text(claim.verdict)},
                                  {"why", claim.why}});
    }
    return json;
}

void print_claims(const std::vector<Claim>& claims) {
    for (const Claim& claim : claims) {
        fmt::print("{:<14} {:<13} {}\n", verdict_text(claim.verdict), claim.section, claim.claim);
    }
}

}  // namespace drude
