// Plots as SVG: lines, points with error bars, bands, on linear or logarithmic axes.
//
// Colours are the eight of Okabe & Ito (2008), which stay apart for every kind of colour vision.
// Text and axes take the colour of their surroundings (currentColor) and every series colour is a
// CSS variable (--series-0 ... --series-7) with the palette as its fallback, so that a page can
// adapt a plot to a dark background; on its own, a plot is black on nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace drude {

enum class Mark { line, points, rings };  // rings: around points of other series

struct Series {
    std::string name;  // empty: not in the legend
    Mark mark = Mark::line;
    std::vector<double> x, y;   // of one length; NaN and infinities break a line, leave out a point
    std::vector<double> error;  // half the height of the error bars, empty or as long as y
    int colour = -1;            // 0 ... 7; -1: the next one
    double width = 1.6;         // of the line, or radius of the points
    double opacity = 1;         // of the drawing, not of the legend
    bool dashed = false;
};

struct Band {
    std::string name;
    std::vector<double> x, low, high;  // of one length; a value that is not finite breaks the band
    int colour = -1;
};

struct Axis {
    std::string label;
    bool logarithmic = false;         // values <= 0 are then treated like NaN
    std::optional<double> low, high;  // otherwise the data decide
};

struct Plot {
    std::string title;
    std::string description;  // for readers who do not see it (SVG desc)
    std::string id = "plot";  // unique in a page that holds several plots
    Axis x, y;
    std::vector<Band> bands;  // drawn beneath the series
    std::vector<Series> series;
    int width = 560, height = 340;  // of the frame and its axes; the legend adds to the height
};

// A complete SVG element. Where there is nothing to draw the axes say "no data". Throws
// std::invalid_argument where the lengths within a series differ.
std::string svg_plot(const Plot& plot);

}  // namespace drude
