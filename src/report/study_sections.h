// The sections of a study's page, in its order.
#pragma once

#include "report/page.h"
#include "report/study_report.h"

namespace drude {

void section_question(Page& page, const Study& study, const StudyPage& content);
void section_samples(Page& page, const Study& study);
void section_captured(Page& page, const Study& study);
void section_fits(Page& page, const Study& study);
void section_lobes(Page& page, const Study& study);
void section_table_1(Page& page, const Study& study);
void section_pictures(Page& page, const Study& study, const StudyPage& content);
void section_claims(Page& page, const StudyPage& content);
void section_figures(Page& page, const StudyPage& content);
void section_sources(Page& page, const Study& study, const StudyPage& content);

// `value` with so many decimals, a dash where it is not finite.
std::string number_text(double value, int decimals);

// "Cu-McPeak (measured)"; the name alone where its kind is not known.
std::string set_with_kind(const StudyMetal& metal, const std::string& set_name);

}  // namespace drude
