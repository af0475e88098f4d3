#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "base/error.h"
#include "base/text_table.h"
#include "markup_checker.h"
#include "report/markup.h"
#include "report/page.h"
#include "report/study_report.h"
#include "report/surface_plot.h"
#include "report/svg_plot.h"
#include "report/ticks.h"

namespace drude {
namespace {

size_t count(const std::string& text, const std::string& what) {
    size_t n = 0;
    for (size_t i = text.find(what); i != std::string::npos; i = text.find(what, i + 1)) ++n;
    return n;
}

bool holds(const std::string& text, const std::string& what) {
    return count(text, what) > 0;
}

std::string labels(const std::vector<Tick>& ticks) {
    std::string out;
    for (const Tick& tick : ticks)
        if (!tick.label.empty()) out += (out.empty() ? "" : " ") + tick.label;
    return out;
}

// A one-pixel grey PNG, made with zlib and checked with a viewer.
std::string small_png() {
    static constexpr unsigned char bytes[] = {
        0x89, 'P',  'N',  'G',  0x0d, 0x0a, 0x1a, 0x0a, 0,    0,    0,    13,   'I',  'H',
        'D',  'R',  0,    0,    0,    1,    0,    0,    0,    1,    8,    0,    0,    0,
        0,    0x3a, 0x7e, 0x9b, 0x55, 0,    0,    0,    10,   'I',  'D',  'A',  'T',  0x78,
        0x9c, 0x63, 0x68, 0,    0,    0,    0x82, 0,    0x81, 0x77, 0xcd, 0x72, 0xb6, 0,
        0,    0,    0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};
    return std::string(bytes, bytes + sizeof bytes);
}

TEST(XmlChecker, FindsWhatIsWrong) {
    EXPECT_EQ(malformed("<a b=\"1\"><c/>x &amp; y</a>\n"), "");
    for (const char* bad :
         {"<a>", "<a></b>", "<a/><b/>", "<a b=1/>", "<a>&nbsp;</a>", "x<a/>",
          "<a b=\"1\" b=\"2\"/>", "<a><b id=\"i\"/><b id=\"i\"/></a>", "<a b=\"<\"/>", ""})
        EXPECT_NE(malformed(bad), "") << bad;
}

TEST(Markup, EscapesWhatMarkupWouldRead) {
    EXPECT_EQ(escape_markup("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
    EXPECT_EQ(escape_markup("Rakić Δ 50°\t\n"), "Rakić Δ 50°\t\n");
    const std::string unknown = "\xef\xbf\xbd";
    EXPECT_EQ(escape_markup(std::string("a\0b\x1b", 4)), "a" + unknown + "b" + unknown);
    EXPECT_EQ(escape_markup("\xff"), unknown);
    EXPECT_EQ(escape_markup("\xc3"), unknown);                              // cut short
    EXPECT_EQ(escape_markup("\xc0\xbc"), unknown + unknown);                // '<' written too long
    EXPECT_EQ(escape_markup("\xed\xa0\x80"), unknown + unknown + unknown);  // a surrogate
    EXPECT_EQ(escape_markup("\xf0\x9f\x94\xac"), "\xf0\x9f\x94\xac");
}

TEST(Markup, Base64AsInRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::string("\xff\xfe\x00\xfb", 4)), "//4A+w==");
}

TEST(Markup, Identifiers) {
    EXPECT_EQ(identifier("Cu, 45° Psi"), "cu-45-psi");
    EXPECT_EQ(identifier("Zinc-coated steel"), "zinc-coated-steel");
    EXPECT_EQ(identifier("°°"), "part");
}

TEST(Ticks, OneTwoFive) {
    EXPECT_EQ(labels(linear_ticks(0, 10, 6)), "0 2 4 6 8 10");
    EXPECT_EQ(labels(linear_ticks(380, 780, 9)), "400 450 500 550 600 650 700 750");
    EXPECT_EQ(labels(linear_ticks(380, 780, 5)), "400 500 600 700");
    EXPECT_EQ(labels(linear_ticks(-1, 1, 5)), "-1.0 -0.5 0.0 0.5 1.0");
    EXPECT_EQ(labels(linear_ticks(0, 0.3, 4)), "0.0 0.1 0.2 0.3");
    EXPECT_EQ(labels(linear_ticks(0, 2e7, 3)), "0 1e+07 2e+07");
    EXPECT_EQ(linear_ticks(0, 0.3, 4).back().value, 0.3);
    EXPECT_EQ(linear_ticks(0, 1, 11)[7].value, 0.7);
    EXPECT_FALSE(std::signbit(linear_ticks(-1, 1, 5)[2].value));
}

TEST(Ticks, NeverMoreThanAskedFor) {
    for (double span = 1e-9; span < 1e9; span *= 1.7) {
        for (const int most : {2, 5, 9}) {
            const auto ticks = linear_ticks(0.3 * span, 1.3 * span, most);
            EXPECT_LE(ticks.size(), static_cast<size_t>(most)) << span;
            for (const Tick& tick : ticks) {
                EXPECT_GE(tick.value, 0.3 * span * (1 - 1e-6));
                EXPECT_LE(tick.value, 1.3 * span * (1 + 1e-6));
            }
        }
    }
}

TEST(Ticks, LogarithmicAxes) {
    EXPECT_EQ(labels(log_ticks(0.01, 1000, 8)), "0.01 0.1 1 10 100 1000");
    EXPECT_EQ(labels(log_ticks(1e-6, 1e-4, 8)), "10⁻⁶ 10⁻⁵ 10⁻⁴");
    EXPECT_EQ(labels(log_ticks(1, 30, 8)), "1 2 5 10 20");
    EXPECT_EQ(labels(log_ticks(4.1, 4.6, 6)), "4.1 4.2 4.3 4.4 4.5 4.6");
    EXPECT_LE(labels(log_ticks(1e-300, 1e300, 6)).size(), 100u);
}

TEST(Ticks, NothingForImpossibleRanges) {
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(linear_ticks(1, 1, 5).empty());
    EXPECT_TRUE(linear_ticks(2, 1, 5).empty());
    EXPECT_TRUE(linear_ticks(nan, 1, 5).empty());
    EXPECT_TRUE(linear_ticks(0, inf, 5).empty());
    EXPECT_TRUE(linear_ticks(-1.7e308, 1.7e308, 5).empty());
    EXPECT_TRUE(log_ticks(0, 1, 5).empty());
    EXPECT_TRUE(log_ticks(-1, 1, 5).empty());
}

Plot simple_plot() {
    Plot plot;
    plot.title = "n & k <of> \"Cu\"";
    plot.description = "Tom's";
    plot.x.label = "λ (nm)";
    plot.y.label = "n";
    Series line;
    line.name = "a<b";
    line.x = {1, 2, 3, 4, 5};
    line.y = {1, 4, 2, 3, 5};
    plot.series = {line};
    return plot;
}

TEST(SvgPlot, IsWellFormedAndAccessible) {
    Plot plot = simple_plot();
    Series points = plot.series[0];
    points.mark = Mark::points;
    points.name = "points";
    points.error = {0.1, 0.2, 0.3, 0, std::nan("")};
    plot.series.push_back(points);
    Band band;
    band.name = "band";
    band.x = {1, 2, 3};
    band.low = {0, 1, 0};
    band.high = {1, 2, 1};
    plot.bands.push_back(band);
    const std::string svg = svg_plot(plot);
    EXPECT_EQ(malformed(svg), "");
    EXPECT_TRUE(holds(svg, "role=\"img\""));
    EXPECT_TRUE(holds(svg, "<title id=\"plot-t\">n &amp; k &lt;of&gt; &quot;Cu&quot;</title>"));
    EXPECT_TRUE(holds(svg, "<desc id=\"plot-d\">Tom&#39;s</desc>"));
    EXPECT_TRUE(holds(svg, ">a&lt;b</text>"));
    EXPECT_EQ(count(svg, "<circle"), 5u + 1u);  // and one in the legend
    EXPECT_FALSE(holds(svg, "nan"));
}

TEST(SvgPlot, PutsValuesWhereTheyBelong) {
    Plot plot;
    plot.width = 400;
    plot.height = 300;
    plot.x.low = plot.y.low = 0;
    plot.x.high = plot.y.high = 10;
    Series points;
    points.mark = Mark::points;
    points.x = {0, 5, 10};
    points.y = {0, 5, 10};
    plot.series = {points};
    const std::string svg = svg_plot(plot);
    double x[3], y[3];
    size_t at = 0;
    for (int i = 0; i < 3; ++i) {
        at = svg.find("<circle", at);
        ASSERT_NE(at, std::string::npos);
        ASSERT_EQ(std::sscanf(svg.c_str() + at, "<circle cx=\"%lf\" cy=\"%lf\"", &x[i], &y[i]), 2);
        ++at;
    }
    EXPECT_NEAR(x[1], 0.5 * (x[0] + x[2]), 0.011);
    EXPECT_NEAR(y[1], 0.5 * (y[0] + y[2]), 0.011);
    EXPECT_GT(x[2] - x[0], 300);
    EXPECT_GT(y[0] - y[2], 200);  // upwards
    // On a logarithmic axis 1, 10, 100 are as far apart.
    plot.y.low = 1;
    plot.y.high = 100;
    plot.y.logarithmic = true;
    plot.series[0].y = {1, 10, 100};
    EXPECT_EQ(count(svg_plot(plot), fmt::format("cy=\"{:.2f}\"", y[1])), 1u);
}

TEST(SvgPlot, BreaksALineAtWhatIsNotANumber) {
    Plot plot = simple_plot();
    plot.series[0].y[1] = std::nan("");
    const std::string broken = svg_plot(plot);
    EXPECT_EQ(malformed(broken), "");
    EXPECT_FALSE(holds(broken, "nan"));
    const size_t path = broken.find("fill=\"none\" style=\"stroke:var");
    const size_t begin = broken.rfind("d=\"", path);
    EXPECT_EQ(count(broken.substr(begin, path - begin), "M"), 2u);
    // A logarithmic axis breaks it where a value is not positive.
    plot.series[0].y = {1, 4, -2, 3, 0};
    plot.y.logarithmic = true;
    const std::string logarithmic = svg_plot(plot);
    EXPECT_EQ(malformed(logarithmic), "");
    EXPECT_FALSE(holds(logarithmic, "nan"));
}

TEST(SvgPlot, DrawsNothingOutOfNothing) {
    Plot plot;
    EXPECT_EQ(malformed(svg_plot(plot)), "");
    EXPECT_TRUE(holds(svg_plot(plot), "no data"));
    plot = simple_plot();
    EXPECT_FALSE(holds(svg_plot(plot), "no data"));
    plot.series[0].y.assign(5, std::nan(""));
    EXPECT_TRUE(holds(svg_plot(plot), "no data"));
    plot.series[0].x.clear();
    EXPECT_THROW(svg_plot(plot), std::invalid_argument);
}

TEST(SvgPlot, SurvivesExtremeValues) {
    Plot plot = simple_plot();
    const double inf = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& y : {std::vector<double>{1.7e308, -1.7e308, 0, inf, -inf},
                                         {3, 3, 3, 3, 3},
                                         {0, 0, 0, 0, 0},
                                         {1e-320, 2e-320, 0, 1e-310, 0},
                                         {1e15, 1e15 + 1, 1e15 + 2, 1e15, 1e15}}) {
        for (const bool logarithmic : {false, true}) {
            plot.series[0].y = y;
            plot.y.logarithmic = logarithmic;
            const std::string svg = svg_plot(plot);
            EXPECT_EQ(malformed(svg), "");
            EXPECT_FALSE(holds(svg, "\"nan") || holds(svg, " nan") || holds(svg, "inf"));
        }
    }
}

// src=, href= and url() may only point into the page itself.
void expect_nothing_fetched(const std::string& html) {
    for (const std::string attribute : {"src=", "href=", "url(", "srcset=", "@import"}) {
        for (size_t i = html.find(attribute); i != std::string::npos;
             i = html.find(attribute, i + 1)) {
            const std::string target = html.substr(i + attribute.size(), 24);
            EXPECT_TRUE(target.rfind("\"data:image/png;base64,", 0) == 0 ||
                        target.rfind("\"#", 0) == 0 || target.rfind("#", 0) == 0)
                << attribute << target;
        }
    }
    // The only "http" is the name of the SVG namespace, which nothing fetches.
    size_t namespaces = count(html, "xmlns=\"http://www.w3.org/2000/svg\"");
    EXPECT_EQ(count(html, "http"), namespaces + count(html, "http-equiv"));
}

TEST(Page, HoldsWhatItIsGivenEscaped) {
    Page page("A <title>");
    page.section("Sect & ion", "Sect & ion");
    page.paragraph("<script>alert(1)</script>");
    page.list({"x < y"});
    page.facts({{"k>", "v\""}});
    page.code("drude <in> & out");
    PageTable table;
    table.columns = {"name", "value"};
    table.numeric = {false, true};
    table.rows = {{"<b>", "1.5"}, {"short"}};
    page.table(table);
    page.picture({small_png(), "alt \"text\""}, "cap <i>");
    page.comparison({small_png(), "left"}, "fitted", {small_png(), "right"}, "literature", "");
    page.markup("<b>taken as it is</b>");
    page.style(".mine{color:red}");
    page.script("/*mine*/");
    page.details("folded <up>", table);
    page.begin_grid();  // never ended: html() closes it
    page.svg(svg_plot(simple_plot()), "");
    const std::string html = page.html();
    EXPECT_TRUE(holds(html, "<title>A &lt;title&gt;</title>"));
    EXPECT_TRUE(holds(html, "&lt;script&gt;alert(1)&lt;/script&gt;"));
    EXPECT_TRUE(holds(html, "<a href=\"#sect-ion\">Sect &amp; ion</a>"));
    EXPECT_TRUE(holds(html, "<section id=\"sect-ion\">"));
    EXPECT_TRUE(holds(html, "<td class=\"number\">1.5</td>"));
    EXPECT_TRUE(holds(html, "<td class=\"number\"></td>"));
    EXPECT_TRUE(holds(html, "width=\"1\" height=\"1\" alt=\"alt &quot;text&quot;\""));
    EXPECT_TRUE(holds(html, base64(small_png())));
    EXPECT_TRUE(holds(html, "<input type=\"range\""));
    EXPECT_TRUE(holds(html, "aria-label=\"Divider between fitted (left) and literature (right)\""));
    for (const char* text : {"<b>taken as it is</b>", ".mine{color:red}", "/*mine*/",
                             "<summary>folded &lt;up&gt;</summary>"})
        EXPECT_TRUE(holds(html, text)) << text;
    EXPECT_TRUE(holds(html, "prefers-color-scheme:dark"));
    EXPECT_TRUE(holds(html, "@media print"));
    EXPECT_EQ(count(html, "<div"), count(html, "</div>"));
    EXPECT_EQ(count(html, "<section"), count(html, "</section>"));
    expect_nothing_fetched(html);
}

TEST(Page, RefusesWhatIsNoPng) {
    Page page("t");
    EXPECT_THROW(page.picture({"", ""}, ""), std::invalid_argument);
    EXPECT_THROW(page.picture({"GIF89a and then some more bytes to be long enough", ""}, ""),
                 std::invalid_argument);
    EXPECT_THROW(page.picture({small_png().substr(0, 20), ""}, ""), std::invalid_argument);
}

OpticalConstants flat_set(const std::string& name, const std::string& kind, double n, double k) {
    OpticalConstants set;
    set.name = name;
    set.material = "Cu";
    set.citation = "A. Author & B. Author, J. Test. 1, 2 (2003)";
    set.kind = kind;
    for (double nm = 300; nm <= 700; nm += 100) {
        set.wavelength_nm.push_back(nm);
        set.n.push_back(n);
        set.k.push_back(k);
    }
    return set;
}

StudyMetal copper() {
    StudyMetal metal;
    metal.name = "Copper";
    metal.folder = "copper";
    metal.sample_set = "Cu-One";
    metal.literature_set = "Cu-Two";
    metal.sample_set_citation = "One et al.";
    metal.literature_set_citation = "Two et al.";
    metal.capture.seed = 17;
    metal.capture.common = {{45, 0.05, 0.1}, {70, 0.05, 0.1}};
    metal.noise_chi2 = 1.75;
    metal.published = {flat_set("Cu-One", "calculated", 1, 2),
                       flat_set("Cu-Two", "measured", 1.5, 2.25)};
    metal.literature = metal.published[1];
    metal.fitted.name = "fitted";
    metal.fitted.kind = "fitted";
    metal.fitted.wavelength_nm = {400, 500, 600};
    metal.fitted.n = {1.25, 1, 1};
    metal.fitted.k = {2, 2.5, 2};
    metal.fitted.sigma_n = {0.01, 0.02, 0.03};
    metal.fitted.sigma_k = {0.04, 0.05, 0.06};
    for (const double nm : {400.0, 500.0, 600.0}) {
        for (const double angle : {45.0, 70.0}) {
            MeasurementRow row;
            row.wavelength_nm = nm;
            row.angle_deg = angle;
            row.psi_deg = 40;
            row.delta_deg = 100;
            row.sigma_psi_deg = 0.05;
            row.sigma_delta_deg = 0.1;
            metal.measurement.rows.push_back(row);
        }
    }
    metal.reduced_chi2 = 1.0123;
    metal.dof = 810;
    metal.rms_dn = 0.1234;
    metal.rms_dk = 0.0567;
    PairStatistics pair;
    pair.log10 = {-1.5, -1.6, -0.5, -0.1};
    pair.pixels = 100;
    pair.mean_absolute = 0.03125;
    pair.mean_delta_e = 1.75;
    metal.pair = pair;
    return metal;
}

StudyInfo study_info() {
    StudyInfo info;
    info.version = "9.8.7";
    info.command_line = "drude reproduce -o \"my folder\"";
    info.environment = "procedural courtyard";
    info.environment_credit = "made by the program";
    info.seconds = 125;
    info.lobe = "blinn-phong";
    info.masking = "v-groove";
    info.beta = 0.011774;
    info.estimator = "psi-delta";
    return info;
}

Study study_of(std::vector<StudyMetal> metals) {
    return {study_info(), std::move(metals), {}};
}

TEST(StudyPage, SaysWhatItIsAndFetchesNothing) {
    StudyMetal bare;  // nothing but its name: everything else missing
    bare.name = "Unobtainium";
    const Study study = study_of({copper(), bare});
    StudyPage content;
    content.folder = "my folder";
    content.sheet_png = small_png();
    content.picture_data = "{\"metals\":[]}";
    content.data_description = "Embedded are <numbers>.";
    content.figures = {paper_figure(study, 5)};
    content.claims = {{"id-1", "4.2", "A <claim>", "A & finding", Verdict::partly, "Because."}};
    const std::string html = study_page(study, content);
    expect_nothing_fetched(html);
    EXPECT_TRUE(holds(html, "The samples are virtual."));
    EXPECT_TRUE(holds(html, "No hardware was used"));
    EXPECT_TRUE(holds(html, "Cu-One (Copper) is calculated"));
    for (const char* text : {"Cu-One",
                             "Cu-Two",
                             ">17<",
                             "1.012",
                             ">2.20<",  // 4 (sqrt(2/810) + sqrt(2/2)/2)
                             ">1.75<",
                             ">2.00<",
                             "0.1234",
                             "0.0567",
                             "-1.60",
                             "drude 9.8.7",
                             "1.75",
                             "drude reproduce -o &quot;my folder&quot;",
                             "procedural courtyard",
                             "2 min 5 s",
                             "blinn-phong lobe, v-groove masking, β = 0.011774 rad",
                             "A. Author &amp; B. Author",
                             "made by the program",
                             "45°, 70°",
                             "Unobtainium",
                             "A &lt;claim&gt;",
                             "A &amp; finding",
                             "partly",
                             "Embedded are &lt;numbers&gt;.",
                             "drude report my folder --figure 5",
                             "id=\"picture-data\">{",
                             "role=\"slider\""})
        EXPECT_TRUE(holds(html, text)) << text;
    EXPECT_EQ(count(html, "<svg xmlns"), 12u + 3u);  // six a metal, three of the figure
    EXPECT_EQ(count(html, "<img"), 1u);
    EXPECT_FALSE(holds(html, ">nan"));
    // Every drawing is well-formed, and their ids do not collide.
    std::string all;
    for (size_t i = html.find("<svg xmlns"); i != std::string::npos;
         i = html.find("<svg xmlns", i + 1))
        all += html.substr(i, html.find("</svg>", i) + 6 - i);
    EXPECT_EQ(malformed("<all>" + all + "</all>"), "");
    // Without what it may lack it is a page all the same.
    const std::string plain = study_page(study, {});
    expect_nothing_fetched(plain);
    EXPECT_FALSE(holds(plain, "id=\"picture-data\"") || holds(plain, "<img"));
}

TEST(StudyTables, ConstantsReadBackExactly) {
    const TextTable table = parse_text_table(study_nk_csv(study_info(), copper()), "nk.csv");
    const std::vector<std::string> columns = {"wavelength_nm", "n_fitted", "k_fitted",
                                              "sigma_n",       "sigma_k",  "n_literature",
                                              "k_literature",  "delta_n",  "delta_k"};
    EXPECT_EQ(table.columns, columns);
    ASSERT_EQ(table.rows.size(), 3u);
    const std::vector<double> first = {400, 1.25, 2, 0.01, 0.04, 1.5, 2.25, -0.25, -0.25};
    EXPECT_EQ(table.rows[0].values, first);
    EXPECT_EQ(table.header_value("sample_set"), "Cu-One");
    EXPECT_EQ(table.header_value("seed"), "17");
    EXPECT_NE(table.header_value("origin").find("virtual bench"), std::string::npos);
    EXPECT_EQ(table.header_value("note"), "");
}

TEST(StudyTables, SaysWhereTheLiteratureEnds) {
    StudyMetal metal = copper();
    metal.fitted.wavelength_nm.back() = 750;
    metal.literature.policy = RangePolicy::error;
    const TextTable table = parse_text_table(study_nk_csv(study_info(), metal), "nk.csv");
    EXPECT_NE(table.header_value("note").find("700"), std::string::npos);
    EXPECT_EQ(table.rows.back().values[5], 1.5);
    metal.literature = {};
    metal.fitted.sigma_n.clear();
    const TextTable alone = parse_text_table(study_nk_csv(study_info(), metal), "nk.csv");
    const std::vector<std::string> columns = {"wavelength_nm", "n_fitted", "k_fitted"};
    EXPECT_EQ(alone.columns, columns);
}

TEST(StudyTables, SummaryHasARowAMetal) {
    StudyMetal broken = copper();
    broken.name = "Silver\nand more";
    broken.pair->log10.max = -std::numeric_limits<double>::infinity();
    StudyMetal unseen = copper();
    unseen.pair.reset();
    const TextTable table =
        parse_text_table(study_summary_csv(study_of({copper(), broken, unseen})), "summary.csv");
    ASSERT_EQ(table.rows.size(), 1u);
    const std::vector<double> row = {1,    17,   1.0123, 810,  0.1234,  0.0567,
                                     -1.5, -1.6, -0.5,   -0.1, 0.03125, 1.75};
    EXPECT_EQ(table.rows[0].values, row);
    EXPECT_EQ(table.header_value("metal_1"), "Copper (sample Cu-One, literature Cu-Two)");
    EXPECT_NE(table.header_value("metal_2_note").find("not finite"), std::string::npos);
    EXPECT_NE(table.header_value("metal_3_note").find("no pictures"), std::string::npos);
}

TEST(PaperFigures, AreWellFormedDocuments) {
    const Study study = study_of({copper()});
    const PaperFigure figure = paper_figure(study, 5);
    EXPECT_EQ(figure.number, 5);
    ASSERT_EQ(figure.rows.size(), 1u);
    EXPECT_EQ(figure.rows[0].size(), 3u);
    std::string document = figure_document(figure);
    EXPECT_TRUE(holds(document, "<title id=\"figure-title\">Figure 5: Copper</title>"));
    EXPECT_TRUE(holds(document, "prefers-color-scheme:dark"));
    const size_t style = document.find("<style>"), end = document.find("</style>");
    document.erase(style, end + 8 - style);  // its braces and quotes are no XML text
    EXPECT_EQ(malformed(document), "");
    EXPECT_FALSE(holds(document, "nan"));
    EXPECT_THROW(paper_figure(study, 6), Error);  // no film
    EXPECT_THROW(paper_figure(study, 7), Error);  // no gold
    EXPECT_THROW(paper_figure(study, 4), Error);
}

TEST(SurfacePlot, PutsPointsAboveTheGrid) {
    SurfacePlot plot;
    plot.title = "a & b";
    plot.grid_x = {0, 1, 2};
    plot.grid_y = {0, 1};
    plot.grid_z = {0, 0, 0, 0, 0, 0};
    plot.lines_x = {1};
    plot.lines_y = {0, 1};
    plot.z.low = 0;
    plot.z.high = 1;
    plot.points = {{1, 0, 0, std::nan("")}, {1, 0, 1, 0}, {5, 0, 1, 0}};
    const std::string svg = surface_plot(plot);
    EXPECT_EQ(malformed(svg), "");
    // Two dots (the third lies outside), the second straight above the first.
    const size_t end = svg.find("stroke-width=\"4\"");
    ASSERT_NE(end, std::string::npos);
    const size_t begin = svg.rfind("d=\"", end);
    double x[2], y[2];
    ASSERT_EQ(std::sscanf(svg.c_str() + begin, "d=\"M%lf %lfh0M%lf %lfh0\"", x, y, x + 1, y + 1),
              4);
    EXPECT_EQ(x[0], x[1]);
    EXPECT_LT(y[1], y[0] - 50);
    plot.grid_z.pop_back();
    EXPECT_THROW(surface_plot(plot), std::invalid_argument);
}

}  // namespace
}  // namespace drude
