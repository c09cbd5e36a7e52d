#pragma once

#include <map>
#include <string>
#include <vector>

#include <chip/handoff/handoff.h>

namespace platform::handoff {

/// RTL of an IP in the user's folders.
struct RtlSources {
  std::string top;                 ///< module or entity
  std::vector<std::string> files;  ///< absolute; empty: none were found
  std::vector<std::string> parameters =
      {};  ///< that the top declares and the design sets: "WIDTH=8"
  std::vector<std::string> interfaces = {};  ///< what the design says of pins: "rst: reset high"
  /// Where the files lie that they include, or read into memories.
  std::vector<std::string> include_dirs = {};
  std::string why = {};  ///< why no file was found, or what does not fit
};

/// Finds RTL of the owner's IP: by the component.xml of a packaged IP, which lists its files, else
/// by the name of the module, with the files of what it instantiates.
class RtlFinder {
 public:
  /// Looks through the folders, 50 000 files at most. Throws vp::InputError for one that is
  /// missing.
  explicit RtlFinder(const std::vector<std::string>& folders);

  RtlSources find(const Module& module) const;
  /// The drivers that lie beside the component.xml of the design's IP. Throws vp::InputError for a
  /// file that cannot be read.
  std::vector<OwnDriver> drivers(const Handoff& handoff) const;
  /// A file that a project names relative to a folder of its own: the one whose path ends so, or
  /// the only one of that name. Empty if no file or several have it.
  std::string data_file(const std::string& path) const;
  /// No folder was named.
  bool empty() const { return empty_; }

 private:
  const std::vector<std::string>& components_of(const Module& module) const;
  RtlSources look(const Module& module) const;
  void add_primitives(RtlSources& sources) const;
  void add_includes(RtlSources& sources) const;
  void add_data(RtlSources& sources) const;
  std::string file_of(const std::string& name, const std::string& user,
                      const std::vector<std::string>& taken) const;
  std::string included(const std::string& name, const std::string& by) const;
  void add_file(const std::string& path);
  RtlSources packaged(const Module& module, const std::string& component) const;
  RtlSources by_name(const Module& module) const;

  bool empty_;
  std::map<std::string, std::vector<std::string>> components_;  ///< by vendor:library:name
  std::map<std::string, std::string> modules_;                  ///< name: its first file
  /// Of names that are declared in several files all of these.
  std::map<std::string, std::vector<std::string>> declared_twice_;
  std::map<std::string, std::vector<std::string>> by_filename_;  ///< what RTL may include or read
};

}  // namespace platform::handoff
