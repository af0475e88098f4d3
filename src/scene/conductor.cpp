// Material "conductor": pbrt-v4's parameters, and the project's own for measured metals.
//
//   "spectrum eta", "spectrum k"   n and k; a metal's name, pairs, or a file each
//   "rgb reflectance"              instead of a metal
//   "float roughness" (uroughness, vroughness, "bool remaproughness")
//                                  alpha of Trowbridge-Reitz with Smith masking; remapped: its root
//   "string material"              a material file, or a published set; instead of eta and k
//   "string lobe", "float beta", "string masking"
//                                  the project's lobes; instead of roughness
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/numbers.h"
#include "materials/film_table.h"
#include "scene/builders.h"
#include "scene/material_parts.h"
#include "scene/spectra.h"

namespace drude {

namespace {

// Runs `body`; an Error that knows no place in the scene gets this one.
template <class Body>
auto at_place(const Place& place, Body&& body) {
    try {
        return body();
    } catch (const Error& error) {
        throw Error(error.cause(), place, error.message());
    }
}

// One of eta and k, as a table; absent means copper, as in pbrt-v4.
struct Constant {
    SampledTable table;
    // Where it is what its role wants of one of the published sets (and not, say, k taken for n).
    const OpticalConstants* set = nullptr;
    Place place;
};

Constant read_constant(ParameterList& list, const std::string& name, bool is_k,
                       BuildContext& context) {
    const Parameter* parameter =
        list.any_of(name, {ParameterType::spectrum, ParameterType::rgb, ParameterType::texture});
    const Place place = list.place_of(name);
    const bool is_name = parameter == nullptr || (parameter->type == ParameterType::spectrum &&
                                                  !parameter->strings.empty());
    if (is_name) {
        const std::string metal =
            parameter ? parameter->strings[0] : std::string(is_k ? "metal-Cu-k" : "metal-Cu-eta");
        const auto found = metal_spectrum(metal, place, context.messages);
        if (found) {
            return {{metal, found->set->wavelength_nm, found->is_k ? found->set->k : found->set->n},
                    found->is_k == is_k ? found->set : nullptr,
                    place};
        }
    }
    if (parameter == nullptr) throw std::logic_error("the published set of copper is missing");
    if (parameter->type == ParameterType::spectrum) {
        return {sampled_table(*parameter, context), nullptr, place};
    }
    const DenseSpectrum spectrum = matter_spectrum(*parameter, context);
    SampledTable table{fmt::format("'{}'", name), {}, {spectrum.begin(), spectrum.end()}};
    for (int i = 0; i < spectrum_size; ++i) table.wavelength_nm.push_back(spectrum_first_nm + i);
    return {std::move(table), nullptr, place};
}

double interpolate(const SampledTable& table, double wavelength) {
    const std::vector<double>& x = table.wavelength_nm;
    const size_t above =
        static_cast<size_t>(std::upper_bound(x.begin(), x.end(), wavelength) - x.begin());
    if (above == 0) return table.values.front();
    if (above == x.size()) return table.values.back();
    const double t = (wavelength - x[above - 1]) / (x[above] - x[above - 1]);
    return table.values[above - 1] * (1 - t) + table.values[above] * t;
}

void note_range(const Constant& constant, BuildContext& context) {
    const SampledTable& table = constant.table;
    if (table.wavelength_nm.front() <= spectrum_first_nm &&
        table.wavelength_nm.back() >= spectrum_last_nm) {
        return;
    }
    context.messages.note(
        constant.place,
        fmt::format("{} covers {} to {} nm of {} to {} nm; its end values are held outside",
                    table.name, format_double(table.wavelength_nm.front()),
                    format_double(table.wavelength_nm.back()), spectrum_first_nm,
                    spectrum_last_nm));
}

// n and k may come on different wavelengths: the union of both, interpolated linearly.
OpticalConstants combine(const Constant& eta, const Constant& k, BuildContext& context) {
    if (eta.set != nullptr && eta.set == k.set) {
        note_range(eta, context);
        return *eta.set;
    }
    note_range(eta, context);
    note_range(k, context);
    OpticalConstants constants;
    constants.name = fmt::format("{} with {}", eta.table.name, k.table.name);
    constants.material = constants.name;
    constants.citation = "given by the scene";
    constants.kind = "given";
    std::vector<double>& grid = constants.wavelength_nm;
    std::set_union(eta.table.wavelength_nm.begin(), eta.table.wavelength_nm.end(),
                   k.table.wavelength_nm.begin(), k.table.wavelength_nm.end(),
                   std::back_inserter(grid));
    for (const double wavelength : grid) {
        const double n_here = interpolate(eta.table, wavelength);
        const double k_here = interpolate(k.table, wavelength);
        if (!(n_here > 0)) {
            user_error_at(eta.place, "eta is {} at {} nm; expected more than 0",
                          format_double(n_here), format_double(wavelength));
        }
        if (!(k_here >= 0)) {
            user_error_at(k.place, "k is {} at {} nm; expected 0 or more", format_double(k_here),
                          format_double(wavelength));
        }
        constants.n.push_back(n_here);
        constants.k.push_back(k_here);
    }
    return constants;
}

Material named_material(ParameterList& list, BuildContext& context) {
    const std::string name = list.text("material", "");
    const Place place = list.place_of("material");
    const bool is_file = name.find('/') != std::string::npos ||
                         (name.size() > 5 && name.substr(name.size() - 5) == ".json");
    Material material;
    if (is_file) {
        const std::string path = context.assets.find(name, place.file, place, "material file");
        // Errors in the file have its own line and column.
        material = parse_material(context.assets.read(path, place), path);
    } else {
        // No set has a name that shown() would change.
        material = at_place(place, [&] { return find_material(shown(name)); });
    }
    const std::string range = material.substrate.range_warning(spectrum_first_nm, spectrum_last_nm);
    if (!range.empty()) context.messages.note(place, range);
    return material;
}

bool allows_smith(Lobe lobe) {
    return lobe == Lobe::beckmann || lobe == Lobe::trowbridge_reitz;
}

// The project's own lobes. A beta means nothing without its lobe, so a lobe needs its beta.
void read_lobe(Material& surface, ParameterList& list) {
    const bool has_lobe = list.has("lobe");
    if (has_lobe && !list.has("beta")) {
        user_error_at(list.place_of("lobe"),
                      "{}: \"string lobe\" without \"float beta\"; expected "
                      "both, since beta has another meaning for every lobe",
                      list.owner());
    }
    if (has_lobe) {
        const std::string lobe = list.text("lobe", "");
        surface.lobe = at_place(list.place_of("lobe"), [&] { return parse_lobe(shown(lobe)); });
        surface.masking = allows_smith(surface.lobe) ? Masking::smith : Masking::v_groove;
    }
    surface.beta = list.number("beta", surface.beta);
    if (list.has("masking")) {
        const std::string masking = list.text("masking", "");
        surface.masking =
            at_place(list.place_of("masking"), [&] { return parse_masking(shown(masking)); });
    }
}

// pbrt's parameters and the project's own do not mix.
void check_exclusive(const ParameterList& list, std::initializer_list<std::string> some,
                     std::initializer_list<std::string> others) {
    for (const std::string& one : some) {
        for (const std::string& other : others) {
            if (list.has(one) && list.has(other)) {
                user_error_at(list.place_of(one),
                              "{}: '{}' and '{}' exclude each other; expected "
                              "one of them",
                              list.owner(), one, other);
            }
        }
    }
}

void check_films(const Material& surface) {
    for (const FilmLayer& layer : surface.layers) {
        if (layer.thickness_nm <= thickest_film_nm) continue;
        user_error(
            "{}: a layer of {} is {} nm thick; films of up to {} nm are drawn, beyond it is a coat "
            "(Material \"coatedconductor\"), or all there is of an opaque one",
            surface.name, layer.constants.name, format_double(layer.thickness_nm),
            format_double(thickest_film_nm));
    }
}

}  // namespace

ConductorMaterial build_conductor(ParameterList& list, const std::string& prefix,
                                  BuildContext& context) {
    const std::string rough = prefix + "roughness", u = prefix + "uroughness",
                      v = prefix + "vroughness", eta = prefix + "eta", k = prefix + "k";
    check_exclusive(list, {"reflectance"}, {eta, k});
    ConductorMaterial conductor;
    if (prefix.empty()) {
        check_exclusive(list, {"material"}, {eta, k, "reflectance"});
        check_exclusive(list, {"lobe", "beta", "masking"}, {rough, u, v});
    }
    if (prefix.empty() && list.has("material")) {
        conductor.surface = named_material(list, context);
    } else if (list.has("reflectance")) {
        conductor.reflectance = reflectance_value(list, "reflectance", 1, context);
        conductor.surface.name = "reflectance";
        conductor.surface.substrate = published_set("Cu");
    } else {
        const Constant n = read_constant(list, eta, false, context);
        const Constant absorption = read_constant(list, k, true, context);
        conductor.surface.substrate = combine(n, absorption, context);
        conductor.surface.name = conductor.surface.substrate.name;
    }
    const bool has_lobe =
        prefix.empty() && (list.has("lobe") || list.has("beta") || list.has("masking"));
    const bool has_roughness = list.has(rough) || list.has(u) || list.has(v);
    if (has_lobe || (prefix.empty() && list.has("material") && !has_roughness)) {
        read_lobe(conductor.surface, list);
        list.boolean("remaproughness", true);
    } else {
        const RoughnessFound found = read_roughness(list, prefix, context);
        conductor.alpha = found.alpha;
        conductor.textured_roughness = found.textured;
        conductor.surface.lobe = Lobe::trowbridge_reitz;
        conductor.surface.masking = Masking::smith;
        conductor.surface.beta = 0;
    }
    at_place(list.place(), [&] {
        conductor.surface.check();
        check_films(conductor.surface);
    });
    return conductor;
}

}  // namespace drude
