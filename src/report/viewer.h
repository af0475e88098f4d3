// The part of a study's page where pairs of pictures are looked into.
#pragma once

#include <string>
#include <vector>

#include "report/study_folder.h"

namespace drude {

// A pair as the page names it.
struct ViewedPair {
    std::string id;    // pair_id()
    std::string name;  // "Copper"
    std::string literature_set;
};

// "copper", "copper-rough": of a pair's figure and of its numbers (report/picture_data.h).
std::string pair_id(const StudyMetal& metal, Finish finish);

// Markup for Page::markup(): the tools, a figure a pair, and `picture_data`
// (report/picture_data.h), which the script turns into pictures in the style "viewer".
std::string viewer_markup(const std::vector<ViewedPair>& pairs, const std::string& picture_data);

// The script for Page::script(): the parts of src/report/web/viewer*.js in one function, so that
// they see each other and nothing else of the page does.
std::string viewer_script();

}  // namespace drude
