// The procedure by which Berger, Weidlich, Wilkie & Magnor 2012 made their Table 1, and what of its
// result is information.
//
// They fitted |rho|^2 = tan^2 Psi at one wavelength, all angles, from literature values: the ratio
// of the Fresnel terms in n and k, then the ratio of two Torrance-Sparrow reflectances
// r_i = Fr_i G D(beta) / (4 cos^2 theta), i = parallel, perpendicular, for four facet distributions
// D, with beta as a third unknown. At the mirror direction G and D are the same factor in both, so
// it cancels: the ratio does not depend on beta and every distribution gives the same n and k.
#pragma once

#include <string>
#include <vector>

#include "fitter/fit_result.h"
#include "fitter/paper_table.h"
#include "materials/optical_constants.h"

namespace drude {

struct LikeThePaperOptions {
    double wavelength_nm = 0;  // 0: the paper's for the metal, else 516; the nearest row is taken
    // Where the fits start; without rows: that of the paper's metal which the sample's name means,
    // else the published set nearest to what psi-delta finds.
    OpticalConstants literature;
};

// One block of the table.
struct PaperFitBlock {
    std::string name;  // of paper_block_names()
    double n = 0, k = 0;
    double rms = 0;  // of the residuals of |rho|^2
    bool converged = false;
    // Of the blocks with a distribution: beta where the fit started and where it ended, from two
    // starts, and the lengths of the Jacobian's columns d|rho|^2/d(n, k, beta) at the end.
    std::vector<double> beta_start, beta_end;
    double column_n = 0, column_k = 0, column_beta = 0;
};

struct PaperFit {
    double wavelength_nm = 0;  // of the rows taken
    std::vector<double> angles_deg;
    std::string literature;           // the set where the fits started
    bool nearest_literature = false;  // taken because no metal was named
    double start_n = 0, start_k = 0;
    std::vector<PaperFitBlock> blocks;  // in the order of paper_block_names()
    // Of n and k of the first block, from the standard deviations of Psi alone.
    double sigma_n = 0, sigma_k = 0;
    FittedPoint psi_delta;                // the same rows with Delta as well
    const PaperMetal* printed = nullptr;  // the paper's column of this metal, or null
    std::vector<std::string> warnings;
};

// Throws Error (user) for what Measurement::check forbids and for a wavelength that is not above 0;
// Error (answer_is_no) where tan^2 Psi does not determine n and k (one angle, say).
PaperFit fit_like_the_paper(const Measurement& measurement, const LikeThePaperOptions& options);

// Table 1 put to the test: one entry a metal.
struct PaperCheck {
    const PaperMetal* metal = nullptr;
    PaperFit fit;              // of |rho|^2 made from the n and k printed for the Fresnel terms
    double largest_error = 0;  // of n and k over the five blocks of `fit`
    // What the five printed pairs differ by, though D and G cancel: the largest rms difference of
    // Psi in degrees from the first pair over the angles, and chi-square over the number of angles
    // that this is at 0.05 degrees.
    double largest_psi_difference_deg = 0, largest_chi2 = 0;
    std::string largest_at;  // the block
    // Blinn-Phong and Beckmann have the same beta printed, although one means a half-height angle
    // and the other a slope.
    bool beta_repeated = false;
};

std::vector<PaperCheck> check_paper_table();

}  // namespace drude
