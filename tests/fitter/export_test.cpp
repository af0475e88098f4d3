#include "fitter/export.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace drude {
namespace {

OpticalConstants example() {
    OpticalConstants constants;
    constants.name = "Xx-Example";
    constants.material = "Xx";
    constants.kind = "measured";
    constants.citation = "A \"quoted\" title\nof two lines";
    constants.wavelength_nm = {400, 1300.0 / 3, 780};
    constants.n = {1.5, 0.1 + 0.2, 2};
    constants.k = {3, 0, 1e-7};
    return constants;
}

TEST(Export, SpdHoldsTheEndsToTheRenderersRange) {
    const std::string n = format_spd(example(), IndexPart::n);
    EXPECT_NE(n.find("\n360 1.5\n400 1.5\n433.3333333333333 0.30000000000000004\n780 2\n830 2\n"),
              std::string::npos)
        << n;
    EXPECT_NE(format_spd(example(), IndexPart::k).find("\n360 3\n400 3\n"), std::string::npos);
    OpticalConstants wide = example();
    wide.wavelength_nm = {300, 500, 900};
    EXPECT_EQ(format_spd(wide, IndexPart::n).find("360"), std::string::npos);
}

TEST(Export, CommentsStayOnTheirLines) {
    for (const std::string& text :
         {format_spd(example(), IndexPart::n), format_constants_csv(example())}) {
        EXPECT_NE(text.find("# citation: A \"quoted\" title of two lines\n"), std::string::npos);
    }
}

TEST(Export, RefractiveIndexInfoIsInMicrometres) {
    const std::string text = format_refractiveindex_info(example());
    EXPECT_NE(text.find("REFERENCES: \"A \\\"quoted\\\" title\\nof two lines\"\n"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("  - type: tabulated nk\n    data: |\n        0.4 1.5 3\n"),
              std::string::npos)
        << text;
}

TEST(Export, CsvHasStandardDeviationsWhereTheyAreKnown) {
    OpticalConstants constants = example();
    EXPECT_NE(format_constants_csv(constants).find("wavelength_nm,n,k\n400,1.5,3\n"),
              std::string::npos);
    constants.sigma_n = constants.sigma_k = {0.01, 0.02, 0.03};
    EXPECT_NE(format_constants_csv(constants).find("n,k,sigma_n,sigma_k\n400,1.5,3,0.01,0.01\n"),
              std::string::npos);
}

TEST(Export, BadTablesAreRefused) {
    OpticalConstants constants = example();
    constants.n[1] = -1;
    EXPECT_THROW(format_spd(constants, IndexPart::n), Error);
    EXPECT_THROW(format_constants_csv(constants), Error);
    EXPECT_THROW(format_refractiveindex_info(constants), Error);
}

}  // namespace
}  // namespace drude
