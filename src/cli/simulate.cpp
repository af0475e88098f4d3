// `drude simulate`: a synthetic measurement.
#include <cstdio>
#include <memory>

#include "base/error.h"
#include "base/numbers.h"
#include "cli/command_list.h"
#include "cli/films.h"
#include "cli/json_output.h"
#include "cli/warnings.h"
#include "device/virtual/ellipsometer_simulation.h"
#include "materials/surface.h"

namespace drude {

namespace {

struct SimulateOptions {
    std::string material;
    std::vector<std::string> films;
    std::string angles = "45,50,60,70,75,80";
    std::string wavelengths = "380:780:5";
    std::string noise = "0.05,0.1";
    uint64_t seed = 1;
    std::string output;
};

SimulationSetup make_setup(const SimulateOptions& options) {
    SimulationSetup setup;
    setup.angles_deg = parse_grid(options.angles, "--angles");
    setup.wavelengths_nm = parse_grid(options.wavelengths, "--wavelengths");
    if (setup.angles_deg.size() * setup.wavelengths_nm.size() > 10'000'000) {
        user_error("found {} wavelengths at {} angles, expected at most ten million rows",
                   setup.wavelengths_nm.size(), setup.angles_deg.size());
    }
    const std::vector<double> noise = parse_grid(options.noise, "--noise");
    if (noise.size() != 2 || options.noise.find(':') != std::string::npos) {
        user_error(
            "--noise: found '{}', expected the standard deviations of Psi and Delta in "
            "degrees, as in 0.05,0.1",
            options.noise);
    }
    setup.sigma_psi_deg = noise[0];
    setup.sigma_delta_deg = noise[1];
    setup.seed = options.seed;
    return setup;
}

int run_simulate(const SimulateOptions& options, const CommonOptions& common) {
    const SimulationSetup setup = make_setup(options);
    if (common.json && options.output.empty()) {
        user_error("expected -o FILE beside --json: stdout takes one of the two only");
    }
    Material material = find_material(options.material);
    lay_films(options.films, &material);
    const Measurement measurement = simulate_ellipsometer(material, setup);
    const std::vector<double> wavelengths = measurement.wavelengths();
    const std::vector<std::string> warnings =
        range_warnings(material, wavelengths.front(), wavelengths.back());
    print_warnings(warnings);
    if (options.output.empty()) {
        fmt::print("{}", format_measurement(measurement));
        return 0;
    }
    write_measurement(options.output, measurement);
    if (common.json) {
        print_json_document({{"rows", measurement.rows.size()},
                             {"wavelengths", wavelengths.size()},
                             {"angles_deg", measurement.angles()},
                             {"sigma_psi_deg", setup.sigma_psi_deg},
                             {"sigma_delta_deg", setup.sigma_delta_deg},
                             {"seed", setup.seed},
                             {"material", material.name},
                             {"output", options.output},
                             {"warnings", warnings}});
    } else {
        fmt::print("{}: {} rows of {} ({} wavelengths, {} angles; simulated, seed {})\n",
                   options.output, measurement.rows.size(), material.name, wavelengths.size(),
                   measurement.angles().size(), setup.seed);
    }
    return 0;
}

}  // namespace

Command simulate_command() {
    Command command;
    command.name = "simulate";
    command.summary = "Make a synthetic measurement of Psi and Delta";
    command.description =
        "Computes what an ellipsometer would measure on a material and adds Gaussian noise. The "
        "result is a measurement file like any other, labelled as simulated. The same seed gives "
        "the same numbers. Noise that would take Psi outside 0 to 90 degrees is reflected there, "
        "with half a turn of Delta: the same polarisation.\n\n"
        "Without -o the file goes to stdout. --noise 0,0 gives the exact values, without standard "
        "deviations in the file.";
    command.example =
        "$ drude simulate Cu-McPeak --angles 45,50,60,70,75,80 --wavelengths 380:780:5 \\\n"
        "      --noise 0.05,0.1 --seed 1 -o cu.csv\n"
        "cu.csv: 486 rows of Cu-McPeak (81 wavelengths, 6 angles; simulated, seed 1)\n";
    command.declare = [](OptionSet& options, const CommonOptions& common) {
        const auto values = std::make_shared<SimulateOptions>();
        options.positional("MATERIAL", values->material, "a set, a material or a material file",
                           true);
        options.option("--film", values->films, "n,k,nm: a film on it; the first is the outermost");
        options.option("--angles", values->angles, "angles of incidence in degrees");
        options.option("--wavelengths", values->wavelengths, "vacuum wavelengths in nm");
        options.option("--noise", values->noise, "standard deviations of Psi and Delta in degrees");
        options.option("--seed", values->seed, "of the noise");
        options.option("-o,--output", values->output, "the measurement file (CSV)");
        return [values, &common] { return run_simulate(*values, common); };
    };
    return command;
}

}  // namespace drude
