// Figures 5 to 8 of Berger, Weidlich, Wilkie & Magnor (IEEE CG&A 32(2), 2012), drawn from a study:
// Psi and Delta against wavelength, the reflectance ratio over angle and wavelength against the
// literature's, n and k fitted against the literature's; copper (5), the oscillating anodised
// aluminium above plain aluminium (6), gold (7), silver (8).
#pragma once

#include <string>
#include <vector>

#include "report/study_data.h"

namespace drude {

struct FigurePanel {
    std::string svg;  // a complete element
    std::string caption;
    int width = 0, height = 0;  // of its viewBox
};

struct PaperFigure {
    int number = 0;
    std::string title;
    std::string caption;                         // what is shown, and what is not as in the paper
    std::vector<std::vector<FigurePanel>> rows;  // of panels side by side
};

// The numbers there are; the pictures of figure 9 are report/figure_9.h's.
inline constexpr int first_svg_figure = 5, last_svg_figure = 8, picture_figure = 9;

// Throws Error (user) where the study lacks the figure's sample.
PaperFigure paper_figure(const Study& study, int number);

// The whole figure as a file of its own: its panels on white, or on black where the reader prefers
// that, with title and caption for those who do not see it.
std::string figure_document(const PaperFigure& figure);

}  // namespace drude
