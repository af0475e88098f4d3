// A function of two variables drawn as a grid in space, with measured points above it: figures 5 to
// 8 of Berger, Weidlich, Wilkie & Magnor (2012) show the reflectance ratio like this.
#pragma once

#include <string>
#include <vector>

#include "report/svg_plot.h"

namespace drude {

struct SurfacePoint {
    double x = 0, y = 0, z = 0;
    double foot = 0;  // where the stem that leads to the point begins; NaN: no stem
};

struct SurfacePlot {
    std::string title;
    std::string description;
    std::string id = "surface";
    Axis x, y, z;  // linear; x runs to the right, y away from the reader, z up
    // z[j * grid_x.size() + i] over grid_x[i], grid_y[j], both ascending with two values at least;
    // lines are drawn along both. Values that are not finite interrupt them.
    std::vector<double> grid_x, grid_y, grid_z;
    std::vector<double> lines_x;  // of grid_x: where a line runs along y
    std::vector<double> lines_y;  // of grid_y: where a line runs along x
    std::vector<SurfacePoint> points;
    std::string grid_name, points_name;  // of the legend
    int width = 560, height = 400;
};

// A complete SVG element in the colours of svg_plot(): the grid in that of the text, the points in
// series colour 0, in parallel projection, far things first. Points outside the frame of x and y
// are left out; z is clipped at none. Throws std::invalid_argument where the grid's shape is wrong.
std::string surface_plot(const SurfacePlot& plot);

}  // namespace drude
