// What the reference integrator's surfaces do to light: dense Mueller matrices between frames that
// have nothing to do with planes of incidence.
//
// Directions are in the world, unit, away from the surface; `in` is where light comes from, `out`
// where the path looks from. Frames are x axes across the rays along -in and along out. Values are
// for radiance: what comes out of a denser medium is less by the squared index.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "materials/mueller.h"
#include "materials/rough_dielectric.h"
#include "render/reference.h"
#include "render/reference_random.h"

namespace drude {

// A point of a surface, seen from `out`.
struct ReferenceVertex {
    glm::dvec3 n;  // shading normal, on the side of `out`
    glm::dvec3 out, frame;
    bool front = true;  // `out` is on the side that the surface's own normal points to
};

class ReferenceSurfaces {
  public:
    // Keeps a reference to `scene`. Throws Error (user) where a coat meets lights without size,
    // which no walk finds.
    ReferenceSurfaces(const Scene& scene, ReferenceOptions::Directions directions,
                      double handedness);

    // Of a mix one of its parts, by chance; -1 is a surface that is not there.
    int chosen(int material, ReferenceRandom& random) const;
    bool is_element(int material) const;
    bool is_dispersive() const { return dispersive_; }

    // The Mueller matrix times |cos| of `in`, per solid angle, at the wavelength nm. Zero where
    // light goes in single directions only, and for coats.
    Mueller<double> scatter(int material, double nm, const ReferenceVertex& v, const glm::dvec3& in,
                            const glm::dvec3& in_frame) const;

    // A way to go on, and what it is worth at each of the wavelengths `nm`: the scattering over the
    // density of choosing it. Nothing: the path ends. Where the index changes with wavelength the
    // first of `nm` decides.
    struct Step {
        glm::dvec3 in, in_frame;
        std::vector<Mueller<double>> worth;
    };
    std::optional<Step> choose(int material, const std::vector<double>& nm,
                               const ReferenceVertex& v, ReferenceRandom& random) const;

    // What an optical element with this x axis and geometric normal does to light along k, in the
    // frame of x axis `frame` before and behind it.
    Mueller<double> element(int material, const glm::dvec3& x_axis, const glm::dvec3& normal,
                            const glm::dvec3& k, const glm::dvec3& frame) const;

  private:
    // One surface's lobe and, seen from within a coat, its metal.
    struct Metal {
        const ConductorMaterial* material = nullptr;
        Material seen;  // against the medium above it
        Microfacets<double> lobe;
    };
    struct Prepared {
        Metal metal;
        RoughDielectric<double> interface;
    };

    Mueller<double> between(const Reflection<double>& r, const glm::dvec3& facet,
                            const glm::dvec3& in, const glm::dvec3& in_frame, const glm::dvec3& out,
                            const glm::dvec3& out_frame) const;
    Reflection<double> metal_reflection(const Metal& metal, double nm, double cosine) const;
    bool goes_one_way(int material, double eta) const;
    double eta_at(int material, double nm, bool front) const;
    std::optional<Step> choose_metal(const Metal& metal, const std::vector<double>& nm,
                                     const ReferenceVertex& v, ReferenceRandom& random) const;
    std::optional<Step> choose_interface(const RoughDielectric<double>& interface,
                                         const std::vector<double>& etas, const ReferenceVertex& v,
                                         ReferenceRandom& random) const;
    std::optional<Step> choose_plate(int material, const std::vector<double>& nm,
                                     const ReferenceVertex& v, ReferenceRandom& random) const;
    std::optional<Step> choose_evenly(int material, const std::vector<double>& nm,
                                      const ReferenceVertex& v, bool both_sides,
                                      ReferenceRandom& random) const;
    std::optional<Step> choose_as_plugin(int material, const std::vector<double>& nm,
                                         const ReferenceVertex& v, ReferenceRandom& random) const;
    std::optional<Step> walk_in_coat(int material, const std::vector<double>& nm,
                                     const ReferenceVertex& v, ReferenceRandom& random) const;

    const Scene& scene_;
    ReferenceOptions::Directions directions_;
    double handedness_;
    bool dispersive_ = false;
    std::vector<Prepared> prepared_;  // by material
};

}  // namespace drude
