// The part of a study's page where pairs of pictures are looked into.
#pragma once

#include <string>
#include <vector>

#include "report/study_data.h"

namespace drude {

// Markup for Page::markup(): the tools, a figure a metal, and `picture_data`
// (report/picture_data.h), which the script turns into pictures in the style "viewer".
std::string viewer_markup(const std::vector<StudyMetal>& metals, const std::string& picture_data);

// The script for Page::script(): the parts of src/report/web/viewer*.js in one function, so that
// they see each other and nothing else of the page does.
std::string viewer_script();

}  // namespace drude
