#include <chip/system/designs.h>

#include <chip/block_design/block_design.h>
#include <chip/block_design/design_file.h>
#include <chip/system/design_plugin.h>
#include <dlfcn.h>
#include <host/process.h>
#include <vp/error.h>
#include <vp/foreign_object.h>
#include <vp/text.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

namespace platform {

namespace {

namespace fs = std::filesystem;

constexpr const char* symbol = "markervp_design";

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw vp::InputError("design '" + file + "' " + why);
}

/// Objects of C++ go to and fro: both sides must have seen the same headers and the same compiler.
void check(const std::string& file, const DesignDescriptor& descriptor) {
  const auto built = [](std::uint32_t abi, const char* version, const char* compiler) {
    return std::string("markervp ") + version + " (designs " + std::to_string(abi) +
           ") with compiler " + compiler;
  };
  const bool same_abi = descriptor.abi == design_abi;
  const std::string theirs = built(descriptor.abi, descriptor.version ? descriptor.version : "?",
                                   descriptor.compiler ? descriptor.compiler : "?");
  const std::string ours = built(design_abi, MARKERVP_VERSION, __VERSION__);
  if (!same_abi || theirs != ours)
    refuse(file, "was built for " + theirs + ", this is " + ours + ": rebuild it");
}

DesignInfo open(const std::string& file) {
  void* handle = vp::load_object(vp::design_object, file);
  vp::keep_object(vp::design_object, file, handle);
  const auto* descriptor = static_cast<const DesignDescriptor*>(::dlsym(handle, symbol));
  if (!descriptor)
    refuse(file,
           std::string("is not a design: it has no '") + symbol + "'; write MARKERVP_DESIGN(…)");
  check(file, *descriptor);
  DesignInfo info;
  vp::call_objects([&] { info = descriptor->info(); });
  if (info.name.empty() || !info.make || !info.words)
    refuse(file, "is incomplete: its DesignInfo needs a name, words and a function that makes it");
  if (info.programs.empty())
    refuse(file, "has no PS program: name at least one in the `programs` of its DesignInfo");
  return info;
}

/// By the absolute path of the file.
std::map<std::string, DesignInfo>& loaded() {
  static std::map<std::string, DesignInfo> designs;
  return designs;
}

}  // namespace

bool is_design_file(const std::string& name) {
  return name.find('/') != std::string::npos || fs::path(name).extension() == ".so" ||
         block_design::is_design_yaml(name);
}

std::string folder_of(const DesignInfo& design) {
  for (const auto& [path, known] : loaded()) {
    if (&known == &design) return fs::path(path).parent_path().string();
  }
  return {};
}

const DesignInfo& load_design(const std::string& file) {
  const std::string path = fs::absolute(file).lexically_normal().string();
  const auto found = loaded().find(path);
  if (found != loaded().end()) return found->second;
  DesignInfo info = block_design::is_design_yaml(path) ? block_design::load(file) : open(path);
  return loaded().emplace(path, std::move(info)).first->second;
}

namespace {

std::vector<DesignRegistration::Describe>& registered() {
  static std::vector<DesignRegistration::Describe> designs;
  return designs;
}

}  // namespace

DesignRegistration::DesignRegistration(std::initializer_list<Describe> designs) {
  registered().insert(registered().end(), designs);
}

const std::vector<const DesignInfo*>& builtin_designs() {
  static const std::vector<const DesignInfo*> designs = [] {
    std::vector<const DesignInfo*> described;
    for (const DesignRegistration::Describe describe : registered())
      described.push_back(&describe());
    return described;
  }();
  return designs;
}

const DesignInfo& design_named(const std::string& name) {
  if (is_design_file(name)) return load_design(name);
  std::vector<std::string> names;
  for (const DesignInfo* design : builtin_designs()) {
    if (design->name == name) return *design;
    names.push_back(design->name);
  }
  const std::string nearest = vp::nearest_match(name, names);
  throw vp::InputError("no design '" + name +
                       "': " + (nearest.empty() ? "" : "did you mean '" + nearest + "'? ") +
                       (names.empty() ? "give" : "choose " + vp::one_of(names) + ", or") +
                       " the file of another one, .so or .yaml");
}

const DesignInfo& design_of_program(const std::string& program) {
  for (const DesignInfo* design : builtin_designs()) {
    const auto& own = design->programs;
    if (std::find(own.begin(), own.end(), program) != own.end()) return *design;
  }
  if (builtin_designs().empty())
    throw vp::InputError(
        "no design: this program has none of its own; give the file of one, .so or .yaml");
  return *builtin_designs().front();
}

bool is_own_program(const std::string& name) {
  const bool is_name = fs::path(name).filename() == name && !fs::path(name).has_extension();
  std::error_code ignored;
  return !is_name || fs::exists(name, ignored);
}

namespace {

/// Where installed programs are.
std::vector<std::string> program_folders() {
  std::vector<std::string> folders = host::library_folders();
  for (std::string& folder : folders) folder = (fs::path(folder) / "programs").string();
  return folders;
}

/// `<name>.so` in the first of these folders that has it; empty: none has.
std::string file_in(const std::vector<std::string>& folders, const std::string& name) {
  std::error_code ignored;
  for (const std::string& folder : folders) {
    const fs::path file = fs::path(folder) / (name + ".so");
    if (fs::exists(file, ignored)) return file.string();
  }
  return {};
}

std::string installed_program(const std::string& name) {
  std::string file = file_in(program_folders(), name);
  if (!file.empty()) return file;
  throw vp::InputError("no program '" + name + "' in " + vp::one_of(program_folders()) +
                       ": give its file, or install markervp completely");
}

/// The first program of a design from outside; empty: missing.
std::string outside_program(const DesignInfo& design) {
  std::vector<std::string> folders = program_folders();
  folders.insert(folders.begin(), folder_of(design));
  return file_in(folders, design.programs.front());
}

}  // namespace

bool has_usual_program(const DesignInfo& design) {
  if (design.programs.empty()) return false;
  return folder_of(design).empty() || !outside_program(design).empty();
}

std::string usual_program(const DesignInfo& design) {
  if (design.programs.empty()) {
    throw vp::InputError("design '" + design.name +
                         "' names no PS program: give one with --program, or list it under "
                         "'programs' of its file");
  }
  const std::string name = design.programs.front(), folder = folder_of(design);
  if (folder.empty()) return installed_program(name);
  std::string file = outside_program(design);
  if (!file.empty()) return file;
  throw vp::InputError("design '" + design.name + "' lacks its PS program '" + name + "': build " +
                       name + ".so in " + folder +
                       " (markervp_add_program), or choose another with --program");
}

std::string program_file(const std::string& name) {
  return is_own_program(name) ? name : installed_program(name);
}

}  // namespace platform
