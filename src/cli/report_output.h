// What `reproduce` and `report` print of a report.
#pragma once

#include <nlohmann/json.hpp>

#include "report/study_report.h"

namespace drude {

// {folder, files, page_bytes, embedded, claims: [{id, section, claim, finding, verdict, why}]}
nlohmann::ordered_json report_json(const std::string& folder, const ReportResult& result);

// A line a claim: verdict, section, claim.
void print_claims(const std::vector<Claim>& claims);

}  // namespace drude
