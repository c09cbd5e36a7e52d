#include <fmt/format.h>

#include <chip/system/designs.h>
#include <cli/app.h>
#include <cli/commands.h>
#include <cli/sweep_command.h>
#include <host/output_folder.h>
#include <marker/code_book.h>
#include <marker/commands/commands.h>
#include <marker/detectors/comparison.h>
#include <marker/input/dictionary_file.h>
#include <marker/input/frame_source.h>
#include <marker/input/image_input.h>
#include <result/page/report_page.h>
#include <vp/error.h>
#include <vp/file.h>
#include <vp/text.h>
#include <vp/unit.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <ostream>

namespace platform::commands {

using namespace cli;

namespace {

/// `markervp compare-detectors`.
struct CompareDetectorsOptions {
  std::vector<std::string> inputs;
  std::vector<std::string> designs;  ///< none: all that come with the program
  ConfigurationOptions configuration;
  std::string profile = "a9-O2";
  std::optional<std::string> camera;
  std::optional<std::string> fit;
  std::optional<std::string> truth;  ///< of all images; none: that of each folder
  std::string output = "out/detectors";
  std::optional<std::string> markdown;  ///< page of the documentation to write
  bool no_report = false;
};

namespace fs = std::filesystem;
using result::Json;
using HostClock = std::chrono::steady_clock;

constexpr double us_per_ms = 1000;
/// What all designs of ours read that have no choice.
constexpr const char* usual_dictionary = "4x4_250";
/// Memory for scenes that all detectors look at: 400 at 640×480.
constexpr std::size_t most_scene_bytes = std::size_t{128} << 20;

double ms_since(HostClock::time_point start) {
  return std::chrono::duration<double, std::milli>(HostClock::now() - start).count();
}

/// A design, built once to see what it takes.
struct Candidate {
  std::string name;
  study::ParameterTable parameters;
};

input::ImageSize size_of(const Candidate& candidate) {
  return input::image_size(candidate.parameters.input());
}

bool same(input::ImageSize a, input::ImageSize b) {
  return a.width == b.width && a.height == b.height;
}

std::string text(input::ImageSize size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height) + " px";
}

class Comparer {
 public:
  Comparer(const CompareDetectorsOptions& options, std::ostream& err)
      : options_(options), err_(err) {
    find_candidates();
    choose_size();
    leave_out_other_sizes();
    choose_markers();
    list_images();
  }

  detectors::Comparison compare() {
    input::keep_scenes(options_.inputs, input_, most_scene_bytes);
    for (const Candidate& candidate : candidates_) run_design(candidate.name);
    if (result_.detectors.empty()) throw vp::InputError(result_.left_out.front().why);
    // Behind the designs: their processes are forked while there is one thread.
    run_peers();
    return std::move(result_);
  }

 private:
  ConfigurationOptions configuration_of(const std::string& design) const {
    ConfigurationOptions configuration = options_.configuration;
    auto& assignments = configuration.assignments;  // the user's own ones win
    assignments.insert(assignments.begin(), {"profile=" + options_.profile, "power.mode=activity"});
    configuration.design = design;
    return configuration;
  }

  void leave_out(const std::string& design, const std::string& why) {
    result_.left_out.push_back({design, why});
  }

  void find_candidates() {
    std::vector<std::string> names = options_.designs;
    if (names.empty()) {
      for (const DesignInfo* design : builtin_designs()) names.push_back(design->name);
    }
    for (const std::string& name : names) {
      try {
        candidates_.push_back({name, study::ParameterTable(elaborate(configuration_of(name)))});
      } catch (const vp::InputError& error) {
        leave_out(name, error.what());
      }
    }
    if (candidates_.empty()) throw vp::InputError(result_.left_out.front().why);
  }

  /// That of the first image, unless images are made to fit; of scenes alone what the first design
  /// takes.
  void choose_size() {
    input_.size = size_of(candidates_.front());
    if (options_.camera) input_.camera = input::read_camera_file(*options_.camera);
    if (options_.fit) input_.fit = *options_.fit == "crop" ? input::Fit::crop : input::Fit::scale;
    if (options_.fit) return;
    input::InputOptions any = input_;
    any.fit = input::Fit::scale;
    any.camera.reset();
    for (const input::InputItem& item : input::list_inputs(options_.inputs, any)) {
      if (item.kind != input::InputItem::Kind::image) continue;
      input_.size = *input::inspect_image(item.source);
      return;
    }
  }

  void leave_out_other_sizes() {
    const auto fits = [&](const Candidate& candidate) {
      return same(size_of(candidate), input_.size);
    };
    for (const Candidate& candidate : candidates_) {
      if (!fits(candidate))
        leave_out(candidate.name, "it takes images of " + text(size_of(candidate)));
    }
    if (std::none_of(candidates_.begin(), candidates_.end(), fits)) {
      throw vp::InputError("no design takes images of " + text(input_.size) +
                           ": use --fit crop or --fit scale, or set pl.width and pl.height");
    }
    keep(fits);
  }

  /// The libraries look for what the designs look for.
  void choose_markers() {
    result_.dictionary = usual_dictionary;
    for (const Candidate& candidate : candidates_) {
      if (!candidate.parameters.has("sw.dictionary")) continue;
      result_.dictionary = candidate.parameters.find("sw.dictionary").value;
      if (const std::string& file = candidate.parameters.find("sw.dictionary_file").value;
          !file.empty()) {
        own_dictionary_ = input::read_dictionary_file(file);
        result_.dictionary = own_dictionary_->name;
      }
    }
    const auto reads_it = [&](const Candidate& candidate) {
      return candidate.parameters.has("sw.dictionary") ||
             (!own_dictionary_ && result_.dictionary == usual_dictionary);
    };
    for (const Candidate& candidate : candidates_) {
      if (!reads_it(candidate))
        leave_out(candidate.name, std::string("it reads no markers but ") + usual_dictionary);
    }
    keep(reads_it);
    set_up_markers(candidates_.front().parameters);
  }

  void set_up_markers(const study::ParameterTable& parameters) {
    const marker::Dictionary* known = marker::find_dictionary(result_.dictionary.c_str());
    if (!own_dictionary_ && known == nullptr)
      throw vp::InputError("sw.dictionary: the libraries know no '" + result_.dictionary + "'");
    const marker::Dictionary words =
        own_dictionary_ ? input::as_dictionary(*own_dictionary_) : *known;
    marker::CodeBook book;
    book.open(words);
    markers_.cells = words.cells;
    markers_.distance = words.distance;
    markers_.corrected = book.corrects();
    markers_.words.assign(words.words, words.words + words.size);
    markers_.border = border_of(parameters);
    if (!parameters.has("sw.marker_side")) return;
    const std::string side = parameters.find("sw.marker_side").value;
    markers_.side_m = vp::parse_quantity(side, vp::Unit::length).to_double();
  }

  /// Cells. What a dictionary's file says counts.
  std::uint32_t border_of(const study::ParameterTable& parameters) const {
    if (own_dictionary_ && own_dictionary_->border != 0) return own_dictionary_->border;
    if (!parameters.has("sw.border_bits")) return 1;
    return static_cast<std::uint32_t>(std::stoul(parameters.find("sw.border_bits").value));
  }

  template <class Condition>
  void keep(const Condition& condition) {
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(),
                                     [&](const Candidate& c) { return !condition(c); }),
                      candidates_.end());
  }

  void list_images() {
    if (options_.truth) truth_beside({});  // wrong, it is reported whether or not an image needs it
    for (const input::InputItem& item : input::list_inputs(options_.inputs, input_)) {
      if (item.kind == input::InputItem::Kind::video)
        throw vp::InputError("'" + item.source + "' is a video: give images, folders or scenes");
      detectors::ImageTruth truth;
      if (item.kind == input::InputItem::Kind::image)
        truth = truth_beside(item.source).of(item.name);
      result_.images.push_back({item.name, truth});
    }
    if (options_.fit) forget_places();
  }

  /// The file that the user named, or that of the image's folder.
  const detectors::Truth& truth_beside(const fs::path& image) {
    const fs::path place = options_.truth ? fs::path(*options_.truth) : image.parent_path();
    const auto known = truths_.find(place);
    if (known != truths_.end()) return known->second;
    return truths_[place] =
               options_.truth ? detectors::Truth::read(place) : detectors::Truth::of_folder(place);
  }

  /// Corners of a truth are those of the image as it lies in the folder.
  void forget_places() {
    for (detectors::Image& image : result_.images) {
      if (!image.truth.markers) continue;
      for (detectors::TrueMarker& marker : *image.truth.markers) marker.corners_px.reset();
    }
  }

  void run_design(const std::string& name) {
    RunOptions run;
    run.inputs = options_.inputs;
    run.configuration = configuration_of(name);
    if (options_.fit) run.input_settings["fit"] = *options_.fit;
    if (options_.camera) run.input_settings["camera"] = *options_.camera;
    const HostClock::time_point start = HostClock::now();
    const Json found = made_apart([&](std::ostream& err) {
      MemoryRun result;
      return run_in_memory(run, result, err) == done ? result.result.take() : Json();
    });
    const double ms = ms_since(start);
    detectors::Detector detector;
    detector.name = name;
    detector.description = design_named(name).description + dropped_text(found);
    detector.host_ms = ms / static_cast<double>(result_.images.size());
    detector.hardware = hardware(found.at("summary"));
    detector.seen.resize(result_.images.size());
    for (const Json& frame : found.at("frames"))
      detector.seen.at(frame.at("index").get<std::size_t>()) = seen_in(frame);
    result_.detectors.push_back(std::move(detector));
  }

  /// Images that came before a design was ready for them show nothing to it.
  std::string dropped_text(const Json& result) const {
    if (!result.contains("camera")) return "";
    const std::size_t dropped = result_.images.size() - result.at("frames").size();
    if (dropped == 0) return "";
    return fmt::format("; dropped {} of {} images, which came at {:g} a second", dropped,
                       result_.images.size(), result.at("camera").at("rate_fps").get<double>());
  }

  static detectors::HardwareFigures hardware(const Json& summary) {
    detectors::HardwareFigures figures;
    if (!summary.contains("fps")) return figures;
    figures.fps = summary.at("fps").at("mean").get<double>();
    figures.latency_ms = summary.at("latency_us").at("mean").get<double>() / us_per_ms;
    if (summary.contains("energy_per_frame_mj"))
      figures.energy_mj = summary.at("energy_per_frame_mj").get<double>();
    return figures;
  }

  static std::vector<detectors::SeenMarker> seen_in(const Json& frame) {
    std::vector<detectors::SeenMarker> seen;
    for (const Json& marker : frame.at("markers")) {
      seen.push_back(
          {marker.at("id").get<int>(), detectors::corners_from(marker.at("corners_px")), {}});
      if (marker.contains("pose")) seen.back().pose = detectors::pose_from(marker.at("pose"));
    }
    return seen;
  }

  void run_peers() {
    const auto peers = detectors::make_peers(markers_);
    std::vector<detectors::Detector> found(peers.size());
    const auto source = input::open_inputs(options_.inputs, input_);
    for (detectors::Image& image : result_.images) {
      const input::SharedFrame frame = source->next();
      if (frame->truth) image.truth = detectors::truth_of(make_scene(frame->name, frame->camera));
      for (std::size_t i = 0; i < peers.size(); ++i) {
        const HostClock::time_point start = HostClock::now();
        found[i].seen.push_back(peers[i]->find(frame->image, frame->camera));
        found[i].host_ms += ms_since(start) / static_cast<double>(result_.images.size());
      }
    }
    for (const std::string& warning : source->warnings())
      err_ << "markervp: warning: " << warning << std::endl;
    for (const std::string& note : source->notes()) err_ << "markervp: note: " << note << std::endl;
    for (std::size_t i = 0; i < peers.size(); ++i) {
      found[i].name = peers[i]->name();
      found[i].description = peers[i]->description();
      result_.detectors.push_back(std::move(found[i]));
    }
  }

  const CompareDetectorsOptions& options_;
  std::ostream& err_;
  std::vector<Candidate> candidates_;
  input::InputOptions input_;
  detectors::MarkerSet markers_;
  std::optional<input::OwnDictionary> own_dictionary_;
  std::map<fs::path, detectors::Truth> truths_;  ///< by their place
  detectors::Comparison result_;
};

constexpr const char* compare_detectors_help =
    R"(  markervp compare-detectors photos --set sw.marker_side=0.05m
  markervp compare-detectors x y z pitch yaw roll
  markervp scenes roll -o rolls; markervp compare-detectors rolls
Errors are reported where the truth is known: of scenes, and of folders with a truth.json (docs/detectors.md). The
libraries look for the dictionary and the size of markers that the designs look for.)";

int compare_detectors(const CompareDetectorsOptions& options, std::ostream& out,
                      std::ostream& err) {
  if (options.markdown) host::prepare_output_file(*options.markdown);
  Comparer comparer(options, err);
  host::OutputFolder folder(options.output);
  const detectors::Comparison result = comparer.compare();
  const auto write = [&](const char* name, const std::string& content) {
    vp::write_file(folder.add(name), content);
  };
  write(page::detectors_name, detectors::to_json(result).dump(2) + "\n");
  write("detectors.csv", detectors::scores_csv(result));
  write("detections.csv", detectors::detections_csv(result));
  std::string wrote = "detectors.json, detectors.csv, detections.csv";
  if (!options.no_report && !page::page_template().empty()) {
    folder.add(page::report_name);
    page::write_report(options.output);
    wrote += ", report.html to look at";
  }
  wrote += " in " + options.output;
  if (options.markdown) {
    vp::write_file(*options.markdown, detectors::markdown_text(result));
    wrote += ", " + *options.markdown;
  }
  out << detectors::console_text(result) << "\nwrote " << wrote << std::endl;
  return done;
}

}  // namespace

cli::Command add_compare_detectors(CLI::App& parser) {
  const auto options = std::make_shared<CompareDetectorsOptions>();
  CompareDetectorsOptions& target = *options;
  CLI::App* command = parser.add_subcommand(
      "compare-detectors", "our designs beside OpenCV's ArUco and AprilTag 3 on the same images");
  command->add_option("INPUT", target.inputs, "folders, images, scenes")->type_name("")->required();
  command
      ->add_option("--design", target.designs,
                   "only this one of ours, may be repeated (default: all that take the images)")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  command->add_option("--truth", target.truth, "what is in the images (default: their truth.json)")
      ->type_name("FILE");
  command->add_option("--camera", target.camera, "camera calibration (OpenCV or ROS)")
      ->type_name("FILE");
  command->add_option("--fit", target.fit, "make images of another size fit")
      ->type_name("crop|scale")
      ->check(CLI::IsMember({"crop", "scale"}).description(""));
  command->add_option("--profile", target.profile, "costs of our software (default: a9-O2)")
      ->type_name("NAME");
  command
      ->add_option("-o,--output", target.output, "folder for the results (default: out/detectors)")
      ->type_name("DIR");
  command->add_option("--markdown", target.markdown, "write the table as a page, too")
      ->type_name("FILE");
  command->add_flag("--no-report", target.no_report, "no page report.html");
  add_configuration_options(*command, target.configuration);
  command->footer(compare_detectors_help);
  return {"compare-detectors",
          [options](const std::vector<std::string>&, std::ostream& out, std::ostream& err) {
            return compare_detectors(*options, out, err);
          }};
}

}  // namespace platform::commands
