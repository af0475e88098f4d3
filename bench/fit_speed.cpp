// How much processor time a fit takes inside the program, reading left out; on one thread.
//
//     fit_speed write FOLDER      the data: metal.csv, film.csv, film_constants.csv
//     fit_speed run FOLDER        times the fits of those data, as JSON
//
// metal.csv: copper (Cu-McPeak) at 45, 50, 60, 70, 75, 80 degrees, 380 to 750 nm by 5; film.csv:
// 3 um of alumina with 10 % of pores on aluminium at 60 and 70 degrees, 380 to 750 nm by 2; noise
// of 0.05 and 0.1 degrees. Each time is the median of 9 runs after one that is not counted.
// bench/peers/fit_peers.py runs it beside other programs.
#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "base/numbers.h"
#include "fitter/film_cases.h"
#include "fitter/fit.h"

namespace {

using namespace drude;
using nlohmann::ordered_json;

constexpr FilmGuess start = {3010, 0.11};

Measurement metal_data() {
    SimulationSetup setup;
    setup.wavelengths_nm = parse_grid("380:750:5", "wavelengths");
    setup.angles_deg = {45, 50, 60, 70, 75, 80};
    return simulate_ellipsometer(find_material("Cu-McPeak"), setup);
}

void write_data(const std::string& folder) {
    make_folder(folder);
    write_measurement(folder + "/metal.csv", metal_data());
    const Measurement film = measured_film(3000, 0.1, 1);
    write_measurement(folder + "/film.csv", film);
    // What both programs know of the sample, at the wavelengths of the data.
    std::string constants = "wavelength_nm,n_film,k_film,n_substrate,k_substrate\n";
    for (const double nm : film.wavelengths()) {
        const Index alumina = published_set("Al2O3-Malitson-o").at(nm);
        const Index aluminium = published_set("Al-Rakic").at(nm);
        constants += fmt::format("{},{},{},{},{}\n", format_double(nm), format_double(alumina.n),
                                 format_double(alumina.k), format_double(aluminium.n),
                                 format_double(aluminium.k));
    }
    write_file(folder + "/film_constants.csv", constants);
}

struct Timed {
    FitResult fit;
    double seconds = 0;
};

Timed timed(const Measurement& data, const FitOptions& options) {
    Timed result;
    result.fit = fit_measurement(data, options);
    std::vector<double> seconds;
    for (int i = 0; i < 9; ++i) {
        // Of the processor: what else the machine does is left out.
        const std::clock_t begin = std::clock();
        result.fit = fit_measurement(data, options);
        seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
    std::nth_element(seconds.begin(), seconds.begin() + 4, seconds.end());
    result.seconds = seconds[4];
    return result;
}

ordered_json bulk_json(const Timed& timed) {
    ordered_json n = ordered_json::array(), k = n, sigma_n = n, sigma_k = n;
    for (const FittedPoint& point : timed.fit.points) {
        n.push_back(point.n);
        k.push_back(point.k);
        sigma_n.push_back(point.sigma_n);
        sigma_k.push_back(point.sigma_k);
    }
    return {{"seconds", timed.seconds}, {"chi2", timed.fit.chi2}, {"n", n}, {"k", k},
            {"sigma_n", sigma_n},       {"sigma_k", sigma_k}};
}

ordered_json film_json(const Timed& timed) {
    const auto& common = timed.fit.common;
    return {{"seconds", timed.seconds},        {"chi2", timed.fit.chi2},
            {"thickness_nm", common[0].value}, {"sigma_thickness_nm", common[0].sigma},
            {"porosity", common[1].value},     {"sigma_porosity", common[1].sigma},
            {"start_nm", start.thickness_nm},  {"start_porosity", start.porosity}};
}

void run(const std::string& folder) {
    FitOptions bulk;
    bulk.threads = 1;
    FitOptions film = anodised_options();
    film.threads = 1;
    FitOptions local = film;
    local.film.start = start;
    const Measurement metal = read_measurement(folder + "/metal.csv");
    const Measurement coated = read_measurement(folder + "/film.csv");
    const ordered_json document = {{"version", DRUDE_VERSION},
                                   {"isa", DRUDE_ISA},
                                   {"bulk", bulk_json(timed(metal, bulk))},
                                   {"film_local", film_json(timed(coated, local))},
                                   {"film_global", film_json(timed(coated, film))}};
    fmt::print("{}\n", document.dump(1));
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc == 3 ? argv[1] : "";
    if (what != "write" && what != "run") {
        fmt::print(stderr, "expected fit_speed write FOLDER, or fit_speed run FOLDER\n");
        return 2;
    }
    try {
        if (what == "write") {
            write_data(argv[2]);
        } else {
            run(argv[2]);
        }
    } catch (const drude::Error& error) {
        fmt::print(stderr, "{}\n", error.message());
        return static_cast<int>(error.cause());
    }
    return 0;
}
