#include "render/film_job.h"

#include <fmt/format.h>

#include "render/transport_choice.h"

namespace drude {

FilmLayout FilmJob::layout() const {
    FilmLayout layout;
    layout.width = width;
    layout.height = height;
    layout.rows = transport == Transport::stokes ? 4 : 1;
    layout.spectral = spectral;
    return layout;
}

std::vector<std::pair<std::string, std::string>> FilmJob::fields() const {
    return {{"scene", scene_hash},
            {"resolution", fmt::format("{}x{}", width, height)},
            {"seed", fmt::format("{}", seed)},
            {"samples a batch", fmt::format("{}", batch_size)},
            {"most reflections", fmt::format("{}", max_depth)},
            {"transport", std::string(transport_name(transport))},
            {"wavelengths", fmt::format("{}", wavelengths)},
            {"spectral layers", spectral ? "yes" : "no"},
            {"analyser", analyser.empty() ? "none" : analyser},
            {"crop", crop.empty() ? "none" : crop},
            {"version", version},
            {"instruction set", instruction_set}};
}

std::string job_differences(const FilmJob& a, const FilmJob& b, bool allow_mixed) {
    const auto fields_a = a.fields(), fields_b = b.fields();
    const size_t compared = fields_a.size() - (allow_mixed ? 1 : 0);
    std::string text;
    for (size_t i = 0; i < compared; ++i) {
        if (fields_a[i].second == fields_b[i].second) continue;
        text += fmt::format("{}{} {} against {}", text.empty() ? "" : ", ", fields_a[i].first,
                            fields_a[i].second, fields_b[i].second);
    }
    return text;
}

std::string joined_instruction_sets(const std::string& a, const std::string& b) {
    // Names hold no '+': "native/avx2+native/sse4.2".
    return ("+" + a + "+").find("+" + b + "+") != std::string::npos ? a : a + "+" + b;
}

FilmCounts& FilmCounts::operator+=(const FilmCounts& other) {
    rays += other.rays;
    projections += other.projections;
    not_finite += other.not_finite;
    out_of_range += other.out_of_range;
    seconds += other.seconds;
    return *this;
}

std::map<std::string, Attribute> picture_attributes(const FilmJob& job, uint32_t first,
                                                    uint32_t fewest) {
    std::map<std::string, Attribute> attributes;
    const int batches = static_cast<int>(fewest);
    const uint64_t from = uint64_t{first} * static_cast<uint64_t>(job.batch_size);
    const int samples = batches * job.batch_size;
    attributes["seed"] = fmt::format("{}", job.seed);
    attributes["samples"] = samples;
    attributes["sampleRange"] = fmt::format("{}:{}", from, from + static_cast<uint64_t>(samples));
    attributes["batches"] = batches;
    attributes["batchSize"] = job.batch_size;
    attributes["sceneHash"] = job.scene_hash;
    attributes["transport"] = std::string(transport_name(job.transport));
    attributes["wavelengths"] = job.wavelengths;
    if (!job.analyser.empty()) attributes["analyser"] = job.analyser;
    if (!job.crop.empty()) attributes["crop"] = job.crop;
    attributes["instructionSet"] = job.instruction_set;
    attributes["drudeVersion"] = job.version;
    if (job.spectral) {
        attributes["spectralLayoutVersion"] = std::string("1.0");
        attributes["emissiveUnits"] = std::string("W.m^-2.sr^-1");
        if (job.transport == Transport::stokes) {
            attributes["polarisationHandedness"] = std::string("right");
        }
    }
    return attributes;
}

std::vector<std::string> count_warnings(const FilmCounts& counts,
                                        const std::vector<std::string>& plugins) {
    std::vector<std::string> warnings;
    const std::string advice =
        plugins.empty() ? "please report this as a bug"
                        : fmt::format(
                              "look into what the plugin {} returns (docs/plugins.md), and "
                              "report it as a bug where that is right",
                              fmt::join(plugins, ", "));
    if (counts.projections > 0) {
        warnings.push_back(fmt::format(
            "{} contributions were outside the cone of physical light by more than rounding; {}",
            counts.projections, advice));
    }
    if (counts.not_finite > 0) {
        warnings.push_back(fmt::format("{} contributions were not numbers and were dropped; {}",
                                       counts.not_finite, advice));
    }
    if (counts.out_of_range > 0) {
        warnings.push_back(fmt::format(
            "{} batches of samples were beyond the range of float32 and count as black: their "
            "pixels are too dark; make the lights weaker",
            counts.out_of_range));
    }
    return warnings;
}

}  // namespace drude
