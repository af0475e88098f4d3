// `drude eval`: one reflection off a smooth surface.
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "base/numbers.h"
#include "cli/command_list.h"
#include "cli/films.h"
#include "cli/json_output.h"
#include "cli/warnings.h"
#include "materials/mueller.h"
#include "materials/surface.h"

namespace drude {

namespace {

struct EvalOptions {
    std::string material;
    double n = 0, k = 0;
    std::vector<std::string> films;
    double angle_deg = 0, wavelength_nm = 0;
};

struct Evaluation {
    std::string name;
    double angle_deg = 0;
    double wavelength_nm = 0;  // 0: not given and not needed
    Index index;
    size_t films = 0;
    Reflection<double> reflection;
    bool has_angles = false;
    double psi_deg = 0, delta_deg = 0;
    std::vector<std::string> warnings;
};

double wrapped(double degrees) {
    const double turned = degrees < 0 ? degrees + 360 : degrees;
    return turned < 360 ? turned : 0;
}

Material wanted_material(const EvalOptions& options, const OptionSet& given) {
    const bool by_index = given.given("--n") || given.given("--k");
    if (by_index && !options.material.empty()) {
        user_error("found a MATERIAL beside --n and --k, expected one or the other");
    }
    if (!by_index && options.material.empty()) {
        user_error("expected a MATERIAL (drude materials lists them) or --n and --k");
    }
    Material material;
    if (by_index) {
        if (!given.given("--n") || !given.given("--k")) {
            user_error("found only {}, expected both --n and --k (k = 0 for a transparent medium)",
                       given.given("--n") ? "--n" : "--k");
        }
        material.substrate = constant_index(options.n, options.k, "--n, --k");
        material.name = material.substrate.name;
    } else {
        material = find_material(options.material);
    }
    lay_films(options.films, &material);
    return material;
}

Evaluation evaluate(const EvalOptions& options, const OptionSet& given) {
    const Material material = wanted_material(options, given);
    if (!given.given("--angle")) user_error("expected --angle, the angle of incidence in degrees");
    if (!(options.angle_deg >= 0 && options.angle_deg < 90)) {
        user_error("--angle: found {}, expected degrees from 0 (along the normal) to below 90",
                   options.angle_deg);
    }
    const bool needs_wavelength = !options.material.empty() || !material.layers.empty();
    if (needs_wavelength && !given.given("--wavelength")) {
        user_error("expected --wavelength, the vacuum wavelength in nm");
    }
    if (given.given("--wavelength") &&
        !(options.wavelength_nm > 0 && options.wavelength_nm <= 1e9)) {
        user_error("--wavelength: found {}, expected nm above 0 and up to 1e9",
                   options.wavelength_nm);
    }
    Evaluation result;
    result.name = material.name;
    result.angle_deg = options.angle_deg;
    result.wavelength_nm = options.wavelength_nm;
    const double wavelength = given.given("--wavelength") ? options.wavelength_nm : 550;
    result.index = material.substrate.at(wavelength);
    result.films = material.layers.size();
    result.warnings = range_warnings(material, wavelength, wavelength);
    result.reflection = reflect(material, wavelength, std::cos(options.angle_deg * pi / 180));
    result.has_angles = has_angles(result.reflection) && !is_vacuum(material, wavelength);
    result.psi_deg = psi(result.reflection) * 180 / pi;
    result.delta_deg = wrapped(delta(result.reflection) * 180 / pi);
    return result;
}

void print_json(const Evaluation& e) {
    using nlohmann::ordered_json;
    ordered_json document = {{"material", e.name},       {"angle_deg", e.angle_deg},
                             {"wavelength_nm", nullptr}, {"films", e.films},
                             {"n", e.index.n},           {"k", e.index.k},
                             {"Rs", e.reflection.Rs},    {"Rp", e.reflection.Rp},
                             {"psi_deg", nullptr},       {"delta_deg", nullptr}};
    if (e.wavelength_nm > 0) document["wavelength_nm"] = e.wavelength_nm;
    if (e.has_angles) {
        document["psi_deg"] = e.psi_deg;
        document["delta_deg"] = e.delta_deg;
    }
    const Mueller<double> matrix = mueller(e.reflection);
    ordered_json numbers = ordered_json::array();
    for (const auto& row : matrix.m) {
        // Adding 0 turns -0 into 0.
        for (const double value : row) numbers.push_back(value + 0.0);
    }
    document["mueller"] = numbers;
    document["warnings"] = e.warnings;
    print_json_document(document);
}

void print_text(const Evaluation& e) {
    std::string where = fmt::format("{} degrees", format_double(e.angle_deg));
    if (e.wavelength_nm > 0) where += fmt::format(", {} nm", format_double(e.wavelength_nm));
    fmt::print("{} at {}\n", e.name, where);
    if (e.films > 0) {
        fmt::print("  under {} film{}; n and k are the substrate's\n", e.films,
                   e.films == 1 ? "" : "s");
    }
    fmt::print("  n     {:<12.8g}  k     {:.8g}\n", e.index.n, e.index.k);
    fmt::print("  Rs    {:<12.8f}  Rp    {:.8f}\n", e.reflection.Rs, e.reflection.Rp);
    if (e.has_angles) {
        fmt::print("  Psi   {:<12.6f}  Delta {:.6f}   (degrees)\n", e.psi_deg, e.delta_deg);
    } else {
        fmt::print("  Psi   -             Delta -          (nothing is reflected)\n");
    }
    fmt::print("  Mueller matrix (S1 > 0 along s)\n");
    const Mueller<double> matrix = mueller(e.reflection);
    for (const auto& row : matrix.m) {
        fmt::print("    {:12.8f} {:12.8f} {:12.8f} {:12.8f}\n", row[0] + 0.0, row[1] + 0.0,
                   row[2] + 0.0, row[3] + 0.0);
    }
}

}  // namespace

Command eval_command() {
    Command command;
    command.name = "eval";
    command.summary = "Evaluate one reflection off a smooth surface";
    command.description =
        "Prints the reflectances Rs and Rp, the ellipsometric angles Psi and Delta and the Mueller "
        "matrix of one reflection in vacuum, off a material (drude materials lists them; a fit's "
        "cu.json is one too) or off a surface of given n and k. Each --film lays one film on it; "
        "the first is the outermost.\n\n"
        "Conventions: N = n + ik, k >= 0 absorbs; rho = conj(r_p/r_s) = tan(Psi) exp(i Delta) with "
        "r_p = -r_s at normal incidence, so that a bare metal has Delta = 180 degrees there, "
        "falling to 0 at grazing. Delta is printed in [0, 360). Where nothing is reflected Psi and "
        "Delta do not exist: null in JSON.";
    command.example =
        "$ drude eval --n 1.04 --k 2.59 --angle 60 --wavelength 550\n"
        "1.04 + 2.59i at 60 degrees, 550 nm\n"
        "  n     1.04          k     2.59\n"
        "  Rs    0.79297036    Rp    0.44505131\n"
        "  Psi   36.839209     Delta 126.836625   (degrees)\n"
        "  ...\n"
        "$ drude eval Al --film 1.77,0,100 --angle 60 --wavelength 550 --json\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<EvalOptions>();
        options.positional("MATERIAL", values->material, "a set, a material or a material file",
                           false);
        options.option("--n", values->n, "refractive index of the surface, instead of MATERIAL");
        options.option("--k", values->k, "extinction coefficient of the surface");
        options.option("--film", values->films, "n,k,nm: a film on it; the first is the outermost");
        options.option("--angle", values->angle_deg, "angle of incidence in degrees");
        options.option("--wavelength", values->wavelength_nm, "vacuum wavelength in nm");
        return [values, &options, &common] {
            const Evaluation evaluation = evaluate(*values, options);
            print_warnings(evaluation.warnings);
            common.json ? print_json(evaluation) : print_text(evaluation);
            return 0;
        };
    };
    return command;
}

}  // namespace drude
