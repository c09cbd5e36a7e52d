#include <chip/block_design/import_design.h>
#include <chip/block_design/shelf.h>
#include <chip/handoff/handoff.h>
#include <chip/handoff/rtl_sources.h>
#include <chip/run/simulation.h>
#include <chip/system/hardware_map.h>
#include <cli/commands.h>
#include <fpga/device/device.h>
#include <host/output_folder.h>
#include <host/process.h>
#include <result/console.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <utility>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

/// What the import before this one wrote, to tell the user's changes from Vivado's.
constexpr const char* last_import = ".import/design.yaml";

/// Writes design.yaml anew, with what the user changed in it since the last import.
class DesignMerge {
 public:
  DesignMerge(fs::path folder, std::string imported)
      : folder_(std::move(folder)), imported_(std::move(imported)) {}

  /// What was done, for people. Throws vp::InputError where both changed the same lines.
  std::string write() const {
    const std::string design = (folder_ / "design.yaml").string();
    const std::string base = (folder_ / last_import).string();
    std::error_code ignored;
    if (!fs::exists(design, ignored)) return replace("wrote");
    if (!fs::exists(base, ignored)) {
      throw vp::InputError("'" + design +
                           "' was not written by 'markervp import': move it away, or "
                           "name another folder");
    }
    const std::string mine = vp::read_text(design, "design"), old = vp::read_text(base, "design");
    if (mine == old) return replace(old == imported_ ? "nothing changed in" : "wrote");
    if (old == imported_) return "kept your " + design + ": nothing changed in Vivado";
    return merge(design, base);
  }

 private:
  std::string replace(const std::string& what) const {
    const std::string design = (folder_ / "design.yaml").string();
    vp::write_file(design, imported_);
    keep_import();
    return what + " " + design;
  }

  void keep_import() const {
    fs::create_directories(folder_ / ".import");
    vp::write_file((folder_ / last_import).string(), imported_);
  }

  std::string merge(const std::string& design, const std::string& base) const {
    const std::string theirs = (folder_ / "design.yaml.new").string();
    vp::write_file(theirs, imported_);
    const host::CommandEnd end = host::run_command({"diff3", "-m", "-E", design, base, theirs});
    if (end.exit_code != 0) {
      throw vp::InputError("you and Vivado changed the same lines of '" + design +
                           "', which stays as it is: bring "
                           "the changes of '" +
                           theirs + "' into it, and import again");
    }
    vp::write_file(design, end.out);
    fs::remove(theirs);
    keep_import();
    return "brought the changes of Vivado into " + design + " and kept yours";
  }

  fs::path folder_;
  std::string imported_;
};

/// A design without its RTL, which is not built yet: stubs are in its place.
std::string without_rtl(const std::string& design) {
  std::string text;
  for (const std::string& line : vp::split(design, '\n'))
    if (line.rfind("    rtl: ", 0) != 0) text += line + "\n";
  return text;
}

/// The platform of the design, built to see that it can be, and for its xparameters.h.
std::string xparameters_of(const fs::path& folder, std::string& problem) {
  const std::string design = (folder / "design.yaml").string();
  const vp::PartFile scratch((folder / ".import/map.yaml").string());
  vp::write_file(scratch.path(), without_rtl(vp::read_text(design, "design")));
  try {
    vp::Configuration configuration;
    configuration.set("design", scratch.path(), "markervp import");
    SimulationOptions asked;
    asked.is_only_shown = true;
    return xparameters_header(build(configuration, asked)->zynq());
  } catch (const vp::InputError& error) {
    problem = error.what();
    const std::size_t at = problem.find(scratch.path());
    if (at != std::string::npos) problem.replace(at, scratch.path().size(), design);
    return {};
  }
}

/// The sources in a folder and below, as Vitis compiles those of an application.
std::vector<std::string> sources_in(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string kind = entry->path().extension().string();
    if (kind == ".c" || kind == ".cc" || kind == ".cpp") files.push_back(entry->path().string());
  }
  if (error) throw vp::InputError("cannot read '" + folder.string() + "': " + error.message());
  if (files.empty()) throw vp::InputError("no source in C or C++ in '" + folder.string() + "'");
  std::sort(files.begin(), files.end());
  return files;
}

/// The sources of the program that the user named, as files or as folders.
std::vector<std::string> program_sources(const std::vector<std::string>& named) {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const std::string& name : named) {
    if (!fs::exists(name, ignored)) throw vp::InputError("no program source '" + name + "'");
    const auto more = fs::is_directory(name, ignored) ? sources_in(name) : std::vector{name};
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

/// Sources as CMake finds them from the folder.
std::vector<std::string> from_folder(const std::vector<std::string>& files,
                                     const fs::path& folder) {
  std::vector<std::string> paths;
  std::error_code ignored;
  for (const std::string& file : files) {
    const fs::path from = fs::weakly_canonical(fs::absolute(folder), ignored);
    paths.push_back(fs::weakly_canonical(fs::absolute(file), ignored).lexically_relative(from));
  }
  return paths;
}

/// Drivers of own IP, of the archive before those in the user's folders. A program that has the
/// sources of one itself keeps them.
std::vector<handoff::OwnDriver> drivers_of(const handoff::Handoff& handoff,
                                           const handoff::RtlFinder& rtl,
                                           const std::vector<std::string>& programs) {
  std::vector<handoff::OwnDriver> drivers = handoff.drivers;
  for (handoff::OwnDriver& driver : rtl.drivers(handoff)) drivers.push_back(std::move(driver));
  const auto is_there = [&](const handoff::OwnDriver& driver) {
    return std::any_of(programs.begin(), programs.end(), [&](const std::string& file) {
      return driver.has(fs::path(file).filename().string());
    });
  };
  drivers.erase(std::remove_if(drivers.begin(), drivers.end(), is_there), drivers.end());
  return drivers;
}

std::vector<std::string> texts_of(const std::vector<std::string>& files) {
  std::vector<std::string> texts;
  texts.reserve(files.size());
  for (const std::string& file : files) texts.push_back(vp::read_text(file, "program"));
  return texts;
}

/// The chip of the hand-off, or the one that the user names in its place: what to say of that.
std::string choose_device(handoff::Handoff& handoff, const std::string& wanted) {
  const std::vector<device::Device>& all = device::devices();
  if (wanted.empty()) {
    if (std::none_of(all.begin(), all.end(),
                     [&](const auto& one) { return one.name() == handoff.device; }))
      throw vp::InputError(handoff.file + ": the design is for an " + handoff.part +
                           ", whose size, speed and power are not known here: --device xc7z020-1 "
                           "imports it as for that chip");
    return {};
  }
  const std::string own = std::exchange(handoff.device, device::find_device(wanted).name());
  if (own == handoff.device) return {};
  return "the hand-off is for an " + handoff.part + ", and was imported as for an " +
         handoff.device +
         ": whether it fits and meets timing, its clocks and watts are of that "
         "chip";
}

}  // namespace

int import_handoff(const ImportOptions& options, std::ostream& out) {
  if (options.shelf) {
    out << block_design::shelf_table();
    return done;
  }
  if (options.file.empty()) throw vp::InputError("import needs a hand-off: .hwh, .xsa or .hdf");
  handoff::Handoff handoff = handoff::read_handoff(options.file, options.block_design);
  const std::string note = choose_device(handoff, options.device);
  const handoff::RtlFinder rtl(options.rtl);
  block_design::ImportedDesign design = block_design::import_design(handoff, rtl);
  if (!note.empty()) design.notes.push_back(note);
  const fs::path folder = options.output.empty() ? handoff.name : options.output;
  const std::vector<std::string> programs = program_sources(options.programs);
  const std::vector<std::string> texts = texts_of(programs);
  const std::vector<std::string> sources = from_folder(programs, folder);
  host::prepare_output_folder(folder.string());
  out << DesignMerge(folder, design.text).write() << "\n";
  const auto write = [&](const std::string& name, const std::string& text) {
    vp::write_file((folder / name).string(), text);
    out << "wrote " << (folder / name).string() << "\n";
  };
  std::error_code ignored;
  std::string problem;
  std::string xparameters = xparameters_of(folder, problem);
  const block_design::DriverFiles drivers =
      block_design::driver_files(handoff, drivers_of(handoff, rtl, programs), xparameters);
  if (!xparameters.empty()) {
    xparameters.insert(xparameters.rfind("\n#endif"), drivers.names);
    write("xparameters.h", xparameters);
  }
  const bool is_sdt = block_design::is_for_device_tree(texts, xparameters);
  if (!sources.empty() || !options.rtl.empty() || !fs::exists(folder / "CMakeLists.txt", ignored))
    write("CMakeLists.txt", block_design::import_cmake(handoff.name, design, sources, is_sdt));
  for (const auto& [name, text] : drivers.files) {
    fs::create_directories((folder / "drivers" / name).parent_path());
    write("drivers/" + name, text);
  }
  write("pl.dtsi", block_design::device_tree(handoff));
  write("registers.json", block_design::register_names(handoff));
  write("IMPORT.md", block_design::import_report(handoff, design, problem));
  const auto stubs = std::count_if(design.parts.begin(), design.parts.end(), [](const auto& part) {
    return part.kind == block_design::Kind::stub;
  });
  out << result::counted(design.parts.size(), "part") << ", " << result::counted(stubs, "stub")
      << ": IMPORT.md has the list\n";
  if (problem.empty()) return done;
  throw vp::InputError(problem);
}

}  // namespace platform::cli
