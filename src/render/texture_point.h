// Where a texture is asked for its value.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/geometry.h"

namespace drude {

class TexturePoint {
  public:
    // p and the unit geometric normal n in the world; the side of n does not matter.
    TexturePoint(const glm::dvec3& p, const glm::dvec3& n, const glm::dvec2& uv)
        : p_(p), n_(n), uv_(uv) {}
    // Of a hit. Its uv is computed when a texture first asks for it; until then both must live.
    TexturePoint(const Geometry& geometry, const Hit& hit)
        : geometry_(&geometry), hit_(&hit), p_(hit.p), n_(hit.ng) {}

    const glm::dvec3& p() const { return p_; }
    const glm::dvec3& n() const { return n_; }
    const glm::dvec2& uv() const {
        if (geometry_ != nullptr) {
            uv_ = geometry_->uv(*hit_);
            geometry_ = nullptr;
        }
        return uv_;
    }

  private:
    mutable const Geometry* geometry_ = nullptr;  // null: uv is known
    const Hit* hit_ = nullptr;
    glm::dvec3 p_, n_;
    mutable glm::dvec2 uv_{0};
};

}  // namespace drude
