// `drude fit` from outside: what it says of a fit beside n and k.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "device/virtual/ellipsometer_simulation.h"
#include "fitter/model_curve.h"
#include "markup_checker.h"
#include "program.h"
#include "report/fit_plots.h"

namespace drude {
namespace {

using nlohmann::json;

std::string simulated(const TemporaryFolder& folder, const std::string& material = "Cu-McPeak") {
    const ProgramRun run =
        run_drude(folder, "simulate " + material +
                              " --angles 60,70,75 --wavelengths 400:700:50 --seed 3 -o m.csv");
    EXPECT_EQ(run.status, 0) << run.err;
    return "m.csv";
}

json fitted(const TemporaryFolder& folder, const std::string& options) {
    const ProgramRun run = run_drude(folder, "fit " + options + " --json");
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out);
}

TEST(FitCommand, ComparesWithTheLiterature) {
    const TemporaryFolder folder;
    const std::string file = simulated(folder);
    const json literature = fitted(folder, file)["literature"];
    EXPECT_EQ(literature["material"], "Cu");
    EXPECT_EQ(literature["chosen_by"], "sample");
    EXPECT_EQ(literature["nearest"], "Cu-McPeak");
    ASSERT_GE(literature["sets"].size(), 4u);
    EXPECT_LT(literature["sets"][0]["rms_dn"], 0.02);
    EXPECT_EQ(literature["sets"][0]["wavelengths"], 7);
    for (size_t i = 0; i < 7; ++i) {
        EXPECT_LT(literature["envelope"]["n_low"][i], literature["envelope"]["n_high"][i]);
    }
    // The same without its name.
    std::string text = read_text(folder.file(file));
    text.erase(0, text.find('\n') + 1);
    write_text(folder.file("x.csv"), text);
    const json nameless = fitted(folder, "x.csv")["literature"];
    EXPECT_EQ(nameless["chosen_by"], "nearest");
    EXPECT_EQ(nameless["nearest"], "Cu-McPeak");
    const ProgramRun run = run_drude(folder, "fit x.csv -o x.json");
    EXPECT_NE(run.out.find("no identification"), std::string::npos) << run.out;
    EXPECT_EQ(fitted(folder, file + " --literature Au")["literature"]["material"], "Au");
    EXPECT_TRUE(fitted(folder, file + " --literature none")["literature"].is_null());
    const ProgramRun wrong = run_drude(folder, "fit m.csv --literature Cu-McPek");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("did you mean 'Cu-McPeak'"), std::string::npos) << wrong.err;
}

TEST(FitCommand, ProfilesAndBootstraps) {
    const TemporaryFolder folder;
    const std::string file = simulated(folder);
    const json fit = fitted(folder, file +
                                        " --angle-offset --profile-at 400,600 --bootstrap 100 "
                                        "--seed 5 --threads 2");
    ASSERT_EQ(fit["profile"].size(), 5u);
    EXPECT_EQ(fit["profile"][0]["name"], "angle offset");
    EXPECT_TRUE(fit["profile"][0]["wavelength_nm"].is_null());
    for (const json& parameter : fit["profile"]) {
        const double value = parameter["value"], sigma = parameter["sigma"];
        EXPECT_NEAR(parameter["intervals"][0]["upper"], value + sigma, 0.1 * sigma);
        EXPECT_NEAR(parameter["intervals"][0]["lower"], value - sigma, 0.1 * sigma);
        EXPECT_FALSE(parameter["intervals"][1]["upper_open"]);
    }
    EXPECT_EQ(fit["bootstrap"]["draws"], 100);
    EXPECT_EQ(fit["bootstrap"]["parameters"][0]["name"], "angle offset");
    EXPECT_EQ(fit["bootstrap"]["points"].size(), 7u);
    const double sigma = fit["bootstrap"]["points"][3]["n"]["sigma"];
    EXPECT_NEAR(sigma, fit["sigma_n"][3], 0.3 * sigma);
    EXPECT_EQ(fit["bootstrap"], fitted(folder, file + " --angle-offset --bootstrap 100 --seed 5 "
                                                      "--threads 1")["bootstrap"]);
    const std::string text =
        run_drude(folder, "fit " + file + " --angle-offset --profile --bootstrap 50").out;
    EXPECT_NE(text.find("profile likelihood"), std::string::npos) << text;
    EXPECT_NE(text.find("bootstrap: 50 draws"), std::string::npos) << text;
}

TEST(FitCommand, RobustLossesAreSaidAloud) {
    const TemporaryFolder folder;
    simulated(folder);
    Measurement data = read_measurement(folder.file("m.csv"));
    data.rows[4].delta_deg += 5;
    write_measurement(folder.file("spoilt.csv"), data);
    const json fit = fitted(folder, "spoilt.csv --robust tukey");
    EXPECT_EQ(fit["robust"]["loss"], "tukey");
    EXPECT_EQ(fit["robust"]["constant"], 4.685);
    EXPECT_GE(fit["robust"]["rows_down_weighted"], 1);
    const std::string text = run_drude(folder, "fit spoilt.csv --robust tukey -o s.json").out;
    EXPECT_NE(text.find("down-weighted"), std::string::npos) << text;
    EXPECT_FALSE(fitted(folder, "spoilt.csv").contains("robust"));
}

TEST(FitCommand, WritesFiguresAndAPage) {
    const TemporaryFolder folder;
    const std::string file = simulated(folder);
    const ProgramRun run =
        run_drude(folder, "fit " + file + " --model auto --profile-at 400 --bootstrap 20 " +
                              "--plots figures --html fit.html -o m.json");
    EXPECT_EQ(run.status, 0) << run.err;
    for (const char* name : {"psi", "delta", "residuals_psi", "residuals_delta", "n", "k"}) {
        const std::string svg = read_text(folder.file(std::string("figures/") + name + ".svg"));
        EXPECT_EQ(malformed(svg), "") << name;
        EXPECT_EQ(svg.find("no data"), std::string::npos) << name;
    }
    const std::string page = read_text(folder.file("fit.html"));
    for (const char* heading : {"Result", "Data and model", "Optical constants", "Literature",
                                "Models tried", "Profile likelihood", "Bootstrap"}) {
        EXPECT_NE(page.find(std::string("<h2>") + heading + "</h2>"), std::string::npos) << heading;
    }
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    // One residual a row of the estimator rho2, and no Delta in them.
    ASSERT_EQ(run_drude(folder, "fit " + file + " --estimator rho2 --plots rho2").status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder.file("rho2/residuals_tan2psi.svg")));
    EXPECT_FALSE(std::filesystem::exists(folder.file("rho2/residuals_delta.svg")));
}

TEST(FitCommand, PrintsWhatTheImporterLeftOut) {
    const TemporaryFolder folder;
    write_text(folder.file("tape.dat"),
               "tape\nVASEmethod[Revs=50]\nnm\n300.0\t65\t12.5\t1.5\t0.25\t3.5\n"
               "dpolE\t300\t55\t1\t1\n");
    const ProgramRun run = run_drude(folder, "fit tape.dat --json");
    EXPECT_NE(run.err.find("warning: 1 of 1 rows of depolarization"), std::string::npos) << run.err;
    const json warnings = json::parse(run.out)["warnings"];
    EXPECT_NE(warnings.at(0).get<std::string>().find("1 of 1 rows of depolarization"),
              std::string::npos);
}

TEST(FitCommand, OptionsThatSayNothingTogetherAreRefused) {
    const TemporaryFolder folder;
    const std::string file = simulated(folder);
    const auto error = [&](const std::string& options) {
        const ProgramRun run = run_drude(folder, "fit " + options);
        EXPECT_EQ(run.status, 2) << options << run.out;
        return run.err;
    };
    EXPECT_NE(error(file + " --seed 4").find("--bootstrap"), std::string::npos);
    EXPECT_NE(error(file + " --bootstrap 3").find("20 to 1000000"), std::string::npos);
    EXPECT_NE(error(file + " --robust hubert").find("huber"), std::string::npos);
    EXPECT_NE(error(file + " --robust huber --profile").find("robust"), std::string::npos);
    EXPECT_NE(error(file + " --profile-at 900").find("400 to 700"), std::string::npos);
    EXPECT_NE(error("--constants Cu --lobe-scan m.csv --html x").find("measurement"),
              std::string::npos);
}

// The curve of Delta runs on where the data cross 360 degrees, on the side where the data are.
TEST(FitFigures, DeltaHasNoSeam) {
    FitReport report;
    report.name = "seam";
    SimulationSetup setup;
    setup.angles_deg = {60, 65, 70};
    for (int nm = 400; nm <= 700; nm += 20) setup.wavelengths_nm.push_back(nm);
    report.measurement = simulate_ellipsometer(find_material("Cu"), setup);
    const std::string expected = [&] {
        report.fit = fit_measurement(report.measurement, report.options);
        return data_figures(report)[1].svg;
    }();
    for (size_t i = 0; i < report.measurement.rows.size(); ++i) {
        if (i >= 9) report.measurement.rows[i].delta_deg -= 360;
    }
    EXPECT_EQ(data_figures(report)[1].svg, expected);
}

TEST(FitCommand, FollowsADispersionFormula) {
    const TemporaryFolder folder;
    const std::string file = simulated(folder, "Ag-McPeak");
    const json fit = fitted(folder, file + " --dispersion compact -o ag.json");
    EXPECT_EQ(fit["dispersion"].get<std::string>().rfind("drude", 0), 0u);
    EXPECT_EQ(fit["parameters"][0]["name"], "eps_inf");
    EXPECT_EQ(fit["parameters"][1]["unit"], "eV");
    EXPECT_EQ(fit["ladder"].size(), 3u);
    EXPECT_LT(fit["chi2_reduced"], 2);
    const ProgramRun wrong = run_drude(folder, "fit m.csv --dispersion drude+2cq");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("did you mean 'cp'"), std::string::npos) << wrong.err;
    const ProgramRun film = run_drude(folder, "fit m.csv --spread 3");
    EXPECT_EQ(film.status, 2);
    EXPECT_NE(film.err.find("--spread"), std::string::npos) << film.err;
    const ProgramRun rough = run_drude(folder, "fit m.csv --roughness fit");
    EXPECT_EQ(rough.status, 1);
    for (const char* idle :
         {"fit m.csv --like-the-paper --dispersion drude",
          "fit m.csv --like-the-paper --html p.html", "fit m.csv --model auto --spread 20",
          "fit m.csv --model auto --roughness fit",
          "fit --lobe-scan s.csv --constants Cu --dispersion drude"}) {
        EXPECT_EQ(run_drude(folder, idle).status, 2) << idle;
    }
}

}  // namespace
}  // namespace drude
