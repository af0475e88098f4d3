// Choosing a light and a direction towards it, and the density of that choice.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "render/environment.h"
#include "render/geometry.h"
#include "render/light_polarisation.h"
#include "render/sampling_strategy.h"
#include "scene/scene.h"

namespace drude {

// Emitters are whole infinite, distant and point lights, and single triangles and spheres of area
// lights. One is picked in proportion to an estimate of the power it sends to the scene; a tenth of
// the picks goes to every light alike, because what power says of a lamp in a wide landscape is
// little, and because a distant light that is never picked would be lost.
class Lights {
  public:
    // Reads the environments' pictures, and samples them as the strategy says. `scene` and
    // `geometry` must outlive it. `constant_skies`: constant infinite lights are picked too
    // (light_choice.h).
    Lights(const Scene& scene, const Geometry& geometry, const SamplingStrategy& strategy = {},
           bool constant_skies = true);

    enum class Kind { environment, constant, distant, point, area };

    struct Sample {
        Kind kind = Kind::constant;
        int light = -1;       // index in the scene's list of that kind
        glm::vec3 d{0};       // towards the light, unit
        float distance = 0;   // infinite for lights without a place
        glm::vec3 target{0};  // a point so close before the light that nothing stands between
        float pdf = 0;        // per solid angle, choice of the light included; 0: no sample
        // No lobe sample ever finds it. The pdf is then what divides the light's own spectrum: of
        // a distant light its choice's alone, of a point light that times the squared distance,
        // over the falloff of a spot.
        bool is_delta = false;
        glm::vec3 rgb{0};                   // radiance from an environment's picture
        ArrivingPolarisation polarisation;  // filled where any_polarised()
    };
    // `at` is where the light is wanted; u_choice, u uniform in [0, 1).
    Sample sample(const glm::vec3& at, float u_choice, const glm::vec2& u) const;

    // Whether there is no light at all, picked or not.
    bool empty() const { return !shines_; }
    // Whether light of some emitter is polarised; otherwise the dop of everything here is 0.
    bool any_polarised() const { return any_polarised_; }

    struct Infinite {
        std::unique_ptr<Environment> environment;  // null: constant
        float choice = 0;                          // probability of being picked
        SkyPolarisation polarisation;
    };
    const std::vector<Infinite>& infinite() const { return infinite_; }
    // The density of sample() towards d for an infinite light.
    float infinite_pdf(size_t light, const glm::vec3& d) const;
    // The same with the picture's radiance, in one look; for lights with a picture.
    Environment::Light picture_light(size_t light, const glm::vec3& d) const {
        Environment::Light found = infinite_[light].environment->light(d);
        found.pdf *= infinite_[light].choice;
        return found;
    }
    // The density of sample() for a hit on an area light, seen from `distance` along d.
    float area_pdf(const Hit& hit, const glm::vec3& d, float distance) const;

    // How polarised the light is that an infinite light sends from d, and that a hit on an area
    // light sends against d.
    ArrivingPolarisation infinite_polarisation(size_t light, const glm::vec3& d) const {
        return infinite_[light].polarisation.arriving(d);
    }
    ArrivingPolarisation area_polarisation(const Hit& hit, const glm::vec3& d) const {
        return area_polarisation(hit.shape, d);
    }

    const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    struct Emitter {
        Kind kind;
        int index;  // of the light (infinite, distant, point) or of the shape (area)
        unsigned primitive = 0;
    };
    // `emitter` and those added since `first_of_light` are one light.
    void add(const Emitter& emitter, double power, size_t first_of_light);
    void make_choice();
    float choice(size_t emitter) const;
    void sample_area(const Emitter& emitter, float choice, const glm::vec3& at, const glm::vec2& u,
                     Sample* sample) const;
    void sample_point(const PointLight& light, float choice, const glm::vec3& at,
                      Sample* sample) const;
    ArrivingPolarisation area_polarisation(int shape, const glm::vec3& d) const;
    ArrivingPolarisation polarisation_of(const Sample& sample, const Emitter& emitter) const;

    const Scene& scene_;
    const Geometry& geometry_;
    std::vector<Infinite> infinite_;
    std::vector<Emitter> emitters_;
    std::vector<double> power_;
    std::vector<size_t> light_of_;     // first emitter of the light that an emitter belongs to
    std::vector<float> cdf_;           // cumulative probability of the emitters
    std::vector<int> first_of_shape_;  // emitter of a shape's first primitive, or -1
    bool any_polarised_ = false, shines_ = false;
    std::vector<UniformPolarisation> distant_polarisation_, point_polarisation_, area_polarisation_;
    std::vector<std::string> warnings_;
};

}  // namespace drude
