// Where in and around a pixel its samples lie: the reconstruction filter as a density.
//
// Every sample belongs to one pixel, so that pixels stay independent of each other whatever the
// filter: positions follow |f|, and a sample where f < 0 counts negatively (Shirley 1991; Ernst,
// Stamminger & Greiner 2006, "Filter Importance Sampling").
#pragma once

#include <vector>

#include "scene/scene.h"

namespace drude {

class PixelFilter {
  public:
    explicit PixelFilter(const Filter& filter);

    // Offset from the pixel's centre along one axis, u in [0, 1); `weight` is the sign of f there
    // over its mean.
    float offset_x(float u, float* weight) const { return x_.offset(u, weight); }
    float offset_y(float u, float* weight) const { return y_.offset(u, weight); }

    // Whether f < 0 somewhere: then pictures may be negative too.
    bool has_negative_lobes() const { return x_.negative || y_.negative; }

  private:
    // pbrt's filters are products of two functions of one coordinate.
    struct Axis {
        float radius = 0.5f;
        std::vector<float> cdf, sign;  // of cells of equal width; an empty cdf is a box
        float scale = 1;
        bool negative = false;
        float offset(float u, float* weight) const;
    };
    static Axis make_axis(const Filter& filter, double radius);
    Axis x_, y_;
};

}  // namespace drude
