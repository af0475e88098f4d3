#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "image/difference.h"
#include "report/figure_9.h"
#include "report/picture_data.h"
#include "report/study_folder.h"
#include "report/study_report.h"
#include "report/viewer.h"

namespace drude {

namespace {

class ReportRun {
  public:
    explicit ReportRun(const ReportOptions& options) : options_(options) {
        result_.study = read_study(options.folder);
    }

    ReportResult one_figure() {
        if (options_.figure == picture_figure) {
            look_at_pictures(false);
        } else {
            write_figure(paper_figure(result_.study, options_.figure));
        }
        return std::move(result_);
    }

    ReportResult everything() {
        Study& study = result_.study;
        StudyPage page;
        page.folder = shown_folder();
        look_at_pictures(true);
        for (int number = first_svg_figure; number <= last_svg_figure; ++number) {
            page.figures.push_back(paper_figure(study, number));
            write_figure(page.figures.back());
        }
        page.claims = result_.claims = paper_claims(study);
        for (const StudyMetal& metal : study.metals) {
            write(metal.folder + "/nk.csv", study_nk_csv(study.info, metal));
        }
        write("summary.csv", study_summary_csv(study));
        page.sheet_png = std::move(sheet_png_);
        page.picture_data = data_.json();
        page.data_description = result_.data_description = data_.description();
        const std::string html = study_page(study, page);
        result_.page_bytes = html.size();
        write("index.html", html);
        return std::move(result_);
    }

  private:
    // The folder's own name: the page may be read on another machine.
    std::string shown_folder() const {
        const auto whole = std::filesystem::absolute(options_.folder).lexically_normal();
        const auto name = whole.has_filename() ? whole.filename() : whole.parent_path().filename();
        return name.empty() ? "." : name.string();
    }

    // Statistics, previews and figure 9; one pair in memory at a time.
    void look_at_pictures(bool all) {
        FigureSheet sheet(result_.study.info.environment_credit);
        for (StudyMetal& metal : result_.study.metals) {
            look_at_pair(&metal, Finish::smooth, all, &sheet);
            if (all && metal.lobe) look_at_pair(&metal, Finish::rough, all, nullptr);
        }
        const Picture picture = sheet.compose();
        write("comparison.png", png(picture));
        // The page shows it reduced: the full one is several megabytes.
        constexpr int widest = 1500;
        if (all) sheet_png_ = png(reduced(picture, (picture.width + widest - 1) / widest));
    }

    void look_at_pair(StudyMetal* metal, Finish finish, bool all, FigureSheet* sheet) {
        const StudyPair pair = read_pair(options_.folder, *metal, finish);
        const PairPictures pictures = pair_pictures(pair, options_.threads);
        if (sheet) sheet->add(metal->name, pictures);
        if (!all) return;
        const bool rough = finish == Finish::rough;
        (rough ? metal->lobe->pair : metal->pair) = pair_statistics(pair.fitted, pair.literature);
        data_.add(pair_id(*metal, finish), pair, rough);
        const std::string end = rough ? "-rough.png" : ".png";
        write(metal->folder + "/fitted" + end, png(pictures.fitted));
        write(metal->folder + "/literature" + end, png(pictures.literature));
        write(metal->folder + "/difference" + end,
              png(with_colour_bar(pictures.difference, log_difference_bar())));
    }

    void write_figure(const PaperFigure& figure) {
        write(fmt::format("figure-{}.svg", figure.number), figure_document(figure));
    }

    void write(const std::string& file, const std::string& bytes) {
        write_file(options_.folder + "/" + file, bytes);
        result_.files.push_back(file);
    }

    ReportOptions options_;
    ReportResult result_;
    PictureData data_;
    std::string sheet_png_;
};

}  // namespace

ReportResult write_report(const ReportOptions& options) {
    const int number = options.figure;
    if (number != 0 && (number < first_svg_figure || number > picture_figure)) {
        user_error("found figure {}, expected one of {} to {}", number, first_svg_figure,
                   picture_figure);
    }
    ReportRun run(options);
    return number == 0 ? run.everything() : run.one_figure();
}

}  // namespace drude
