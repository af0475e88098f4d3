// For authors of plugins in C++: from a matrix in the s-p frames of the half vector, where models
// are simple, to the frames that the renderer asks for. Needs plugin.h alone.
#pragma once

#include <cmath>

#include "plugin.h"

namespace drude_plugin {

struct Vector {
    float x, y, z;
};
inline Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator*(float f, const Vector& a) {
    return {f * a.x, f * a.y, f * a.z};
}
inline Vector operator-(const Vector& a) {
    return -1.0f * a;
}
inline float dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Length 1; a vector of length 0 stays as it is.
inline Vector normalised(const Vector& a) {
    const float size2 = dot(a, a);
    return size2 > 0 ? (1 / std::sqrt(size2)) * a : a;
}
inline Vector vector(const float v[3]) {
    return {v[0], v[1], v[2]};
}

// The geometry of one reflection about the half vector h of in and out: s = perpendicular to the
// plane of incidence on the facet, shared by both rays, p = handedness * cross(k, s) on each.
class HalfVectorFrames {
  public:
    explicit HalfVectorFrames(const DrudeDirections& d) {
        const Vector in = vector(d.in), out = vector(d.out);
        half_ = normalised(in + out);
        s_ = cross(in, out);
        // Straight back every azimuth serves: B = S = 0 and C = -A there. What is across `in`:
        if (!(dot(s_, s_) > 1e-12f)) {
            s_ = std::abs(in.z) < 0.9f ? cross(in, {0, 0, 1}) : cross(in, {1, 0, 0});
        }
        s_ = normalised(s_);
        turn_between(-in, vector(d.x_in), s_, d.handedness, &cos2_in_, &sin2_in_);
        turn_between(out, vector(d.x_out), s_, d.handedness, &cos2_out_, &sin2_out_);
    }

    const Vector& half() const { return half_; }
    const Vector& s() const { return s_; }

    // `m`, row-major: from the frames (s, p) of both rays to (x_in, y_in) and (x_out, y_out).
    void to_ray_frames(float m[16]) const {
        // From the right: components in (x_in, y_in) become those in (s, p). Columns 1 and 2.
        for (int i = 0; i < 4; ++i) {
            const float a = m[4 * i + 1], b = m[4 * i + 2];
            m[4 * i + 1] = a * cos2_in_ - b * sin2_in_;
            m[4 * i + 2] = a * sin2_in_ + b * cos2_in_;
        }
        // From the left: those in (s, p) become those in (x_out, y_out). Rows 1 and 2.
        for (int j = 0; j < 4; ++j) {
            const float a = m[4 + j], b = m[8 + j];
            m[4 + j] = cos2_out_ * a - sin2_out_ * b;
            m[8 + j] = sin2_out_ * a + cos2_out_ * b;
        }
    }

  private:
    // cos and sin of twice the angle from x to s on a ray along k, counted from x towards y.
    static void turn_between(const Vector& k, const Vector& x, const Vector& s, float handedness,
                             float* cos2, float* sin2) {
        const float c = dot(s, x), t = handedness * dot(s, cross(k, x));
        const float size2 = c * c + t * t;
        *cos2 = size2 > 0 ? (c * c - t * t) / size2 : 1;
        *sin2 = size2 > 0 ? 2 * c * t / size2 : 0;
    }

    Vector half_, s_;
    float cos2_in_ = 1, sin2_in_ = 0, cos2_out_ = 1, sin2_out_ = 0;
};

}  // namespace drude_plugin
