// What people look at, made from a study's folder: the page, the figures, the tables.
#pragma once

#include <string>
#include <vector>

#include "report/claims.h"
#include "report/paper_figures.h"
#include "report/study_data.h"

namespace drude {

// What the page shows beside the study itself.
struct StudyPage {
    std::vector<Claim> claims;
    std::vector<PaperFigure> figures;
    std::string sheet_png;         // figure 9; empty: left out
    std::string picture_data;      // JSON (report/picture_data.h); empty: no pairs to look into
    std::string data_description;  // what that holds, for people
    std::string folder;            // its name, for commands
};

// A self-contained HTML document.
std::string study_page(const Study& study, const StudyPage& page);

// The n, k of one metal as a text table (base/text_table.h): wavelength_nm, n_fitted, k_fitted,
// sigma_n, sigma_k (where known), n_literature, k_literature, delta_n, delta_k (fitted minus
// literature, interpolated linearly; outside its range the literature's end value, said in the
// header).
std::string study_nk_csv(const StudyInfo& info, const StudyMetal& metal);

// One row a metal, in the order given (header keys metal_1, metal_2, ... name them): metal, seed,
// reduced_chi2, dof, rms_dn, rms_dk and, of the pictures, log10_mean, log10_p50, log10_p99,
// log10_max, mean_absolute, mean_delta_e. A metal without pictures, or with a figure that is not
// finite, has no row, and the header says so.
std::string study_summary_csv(const Study& study);

struct ReportOptions {
    std::string folder;
    int threads = 0;
    // 0: everything; 5 to 9: that figure of the paper alone.
    int figure = 0;
};

struct ReportResult {
    Study study;
    std::vector<Claim> claims;       // empty where one figure alone was asked for
    std::vector<std::string> files;  // written, relative to the folder
    std::string data_description;
    size_t page_bytes = 0;
};

// Reads the folder's record, measurements, fits and EXRs, renders nothing, and writes, for every
// metal, METAL/nk.csv, fitted.png, literature.png, difference.png and the same of the rough pair
// (fitted-rough.png, ...); figure-5.svg to figure-8.svg,
// comparison.png (figure 9), summary.csv and index.html. Throws Error.
ReportResult write_report(const ReportOptions& options);

}  // namespace drude
