#include <filesystem>
#include <ostream>

#include <cli/commands.h>
#include <cli/program.h>
#include <page/page_file.h>
#include <page/report_page.h>
#include <sweep/report.h>
#include <vp/error.h>

namespace platform::cli {

int make_report(const ReportOptions& options, std::ostream& out) {
  if (page::page_template().empty()) {
    throw vp::InputError(
        "this markervp was built without report.html: build it again with Node.js and npm "
        "(Debian: nodejs npm)");
  }
  std::string file;
  if (options.folders.size() == 1) {
    if (options.output) {
      throw vp::InputError("--output is for a comparison: the page of one folder stands in it");
    }
    const std::string& folder = options.folders[0];
    std::error_code ignored;
    if (std::filesystem::exists(std::filesystem::path(folder) / "manifest.json", ignored)) {
      const sweep::Store store(folder);
      sweep::write_page(sweep::read_results(store, store.read_manifest()), folder);
    } else {
      page::write_report(folder);
    }
    file = (std::filesystem::path(options.folders[0]) / "report.html").string();
  } else {
    file = options.output.value_or("compare.html");
    page::write_comparison(options.folders[0], options.folders[1], file);
  }
  out << "wrote " << file << std::endl;
  return done;
}

}  // namespace platform::cli
