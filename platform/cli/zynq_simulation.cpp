#include <cli/zynq_simulation.h>

#include <filesystem>

#include <input/library_folder.h>
#include <vp/error.h>
#include <vp/text.h>
#include <zynq/session.h>

namespace platform::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* usual_program = "hybrid";

/// A word without folder and extension names an installed program, unless a file is called so.
std::string program_file(const std::optional<std::string>& asked) {
  const std::string name = asked.value_or(usual_program);
  const bool is_name = fs::path(name).filename() == name && !fs::path(name).has_extension();
  std::error_code ignored;
  if (asked && (!is_name || fs::exists(name, ignored))) return name;
  std::vector<std::string> folders;
  for (const std::string& folder : input::library_folders()) {
    const fs::path programs = fs::path(folder) / "programs";
    const fs::path file = programs / (name + ".so");
    if (fs::exists(file, ignored)) return file.string();
    folders.push_back(programs.string());
  }
  throw vp::InputError("no program '" + name + "' in " + vp::one_of(folders) +
                       ": give its file, or install markervp completely");
}

class ZynqSimulation : public Simulation {
 public:
  explicit ZynqSimulation(const SimulationOptions& options)
      : session_({program_file(options.program), options.trace}) {}

  input::ImageSize image_size() const override { return session_.image_size(); }
  report::RunFacts facts() const override { return session_.facts(); }
  void run(const NextFrame& next, const FrameDone& done) override { session_.run(next, done); }

 private:
  Session session_;
};

}  // namespace

std::unique_ptr<Simulation> make_zynq_simulation(const SimulationOptions& options) {
  return std::make_unique<ZynqSimulation>(options);
}

}  // namespace platform::cli
