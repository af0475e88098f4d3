// The part of a study's page where pairs of pictures are looked into.
#pragma once

#include <string>
#include <vector>

#include "report/study_data.h"

namespace drude {

// Markup for Page::markup(): the tools, a figure a metal, and `picture_data`
// (report/picture_data.h), which the script "viewer" (report/web.h) turns into pictures in its
// style of the same name.
std::string viewer_markup(const std::vector<StudyMetal>& metals, const std::string& picture_data);

}  // namespace drude
