// Figure 9 of Berger et al. (2012): the rendered pairs, tone-mapped, and their difference.
#pragma once

#include <string>
#include <vector>

#include "image/sheet.h"
#include "report/study_folder.h"

namespace drude {

// What people see of one pair.
struct PairPictures {
    Picture fitted, literature;  // tone-mapped after Durand & Dorsey (2002), one curve for both
    Picture difference;          // log10 of the mean |fitted - literature|, fixed range
};
PairPictures pair_pictures(const StudyPair& pair, int threads);

// Rows fitted, literature, difference; a column a metal.
class FigureSheet {
  public:
    // `credit`: whose environment the pictures show, written above them; "" for none.
    explicit FigureSheet(const std::string& credit);
    void add(const std::string& metal, const PairPictures& pictures);
    Picture compose() const { return compose_sheet(sheet_); }

  private:
    Sheet sheet_;
};

// The mean of each block of `factor` x `factor` pixels (fewer at the right and lower edges), of
// linear values.
Picture reduced(const Picture& picture, int factor);

std::string png(const Picture& picture);

}  // namespace drude
