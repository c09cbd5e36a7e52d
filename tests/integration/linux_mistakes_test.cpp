// Linux applications that go wrong, and what cannot be run as one.
#include <boost/test/unit_test.hpp>

#include <linux/capability.h>
#include <sys/xattr.h>

#include <csignal>
#include <filesystem>

#include "linux_place.h"

using namespace integration;

namespace {

struct Mistakes : LinuxPlace {
  Arguments arguments(const std::string& mistake, const Arguments& options = {}) const {
    Arguments all{"--linux", MARKERVP_APPLICATIONS "mistakes", "--no-report", "--quiet", mistake};
    all.insert(all.end(), options.begin(), options.end());
    return all;
  }
  /// The last line that it says must have all of `parts`.
  void ends(int exit_code, const std::string& mistake, const Arguments& parts,
            const Arguments& options = {}) const {
    BOOST_TEST_CONTEXT(mistake) {
      const kit::Outcome outcome = run(arguments(mistake, options));
      BOOST_TEST(outcome.signal == 0);
      BOOST_TEST(outcome.exit_code == exit_code, outcome.err);
      for (const std::string& part : parts)
        BOOST_TEST((outcome.err.find(part) != std::string::npos),
                   "'" << part << "' is not in: " << outcome.err);
    }
  }
  /// The run is stopped, and its result says so.
  void stops(const std::string& mistake, const Arguments& parts,
             const Arguments& options = {}) const {
    ends(3, mistake, parts, options);
    BOOST_TEST(result()["incomplete"] == "stopped by an error");
  }
  void warns(const std::string& mistake, const Arguments& parts) const { ends(0, mistake, parts); }

  void refuses(const Arguments& words, const Arguments& parts) const {
    const kit::Outcome outcome = run(words);
    BOOST_TEST(outcome.exit_code == 2, outcome.err);
    BOOST_TEST(outcome.out == "");
    for (const std::string& part : parts)
      BOOST_TEST((outcome.err.find(part) != std::string::npos),
                 "'" << part << "' is not in: " << outcome.err);
    BOOST_TEST(!std::filesystem::exists(*this / "out"));
  }
  std::string copy(const std::string& name, std::filesystem::perms more) const {
    const std::string file = *this / name;
    std::filesystem::copy_file(MARKERVP_APPLICATIONS "gpio", file);
    std::filesystem::permissions(file, more, std::filesystem::perm_options::add);
    return file;
  }
};

const std::string in_main = ", called from main (";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(linux_mistakes, Mistakes)

BOOST_AUTO_TEST_CASE(accesses_that_no_device_takes) {
  stops("unmapped", {"data abort: write to 0x50000000 (m_axi_gp0): DECERR, nothing answers there",
                     " of program 'mistakes', pc 0x", " unmapped+0x", "mistakes.c:34)", in_main});
  stops("unaligned", {"unaligned access: 4 bytes at 0x41200002", "SIGBUS", "mistakes.c:42)"});
  stops("wide", {"8 bytes at once: 'unsigned long' has 8 bytes here", "mistakes.c:47)"});
  stops("vector", {"0x41200000 with a vector instruction", "or with memcpy()", "mistakes.c:53)"});
  stops("atomic", {"an atomic operation, which device registers do not have", "mistakes.c:58)"});
  stops("copying", {"from register to register in one instruction, at 0x41200000"});
}

BOOST_AUTO_TEST_CASE(mappings) {
  stops("private_map", {"mmap() of the registers at 0x41200000 with MAP_PRIVATE", "use MAP_SHARED",
                        "called from private_map (", in_main});
  stops("read_only", {"writes to the registers at 0x41200000", "without PROT_WRITE"});
  stops("leaks", {"more than 64 device files and attributes open", " leaks+0x"});
  stops("stream", {"opens /dev/uio0 with fopen()", "use open()", " stream+0x"});
  stops("reopens", {"opens /dev/uio0 with freopen()", "use open()", " reopens+0x"});
}

BOOST_AUTO_TEST_CASE(walks_inside_the_c_library) {
  stops("walks",
        {"nftw() walks through /sys/class/uio inside the C library", "use opendir()", " walks+0x"});
  stops("walks_by_fts", {"fts_open() walks through /dev/uio0", " walks_by_fts+0x"});
  stops("expands", {"wordexp() walks through /sys/class/uio/", " expands+0x"});
}

BOOST_AUTO_TEST_CASE(what_bare_metal_programs_are_told_too) {
  warns("no_register",
        {"pl.axi_gpio_0.s_axi: write to 0x00000190, where the device has no register",
         " no_register+0x", "mistakes.c:38)", in_main});
  warns("unflushed", {"a DMA reads 0x10", "which the program never flushed",
                      "write 1 to sync_for_device before the transfer", " unflushed+0x"});
  warns("beyond_a_map",
        {"mmap() of 4096 bytes at offset 0x1000: of this file 0x10000 can be mapped",
         "beyond_a_map+0x"});
  warns("no_interrupt", {"/dev/uio2 give EIO: axi_gpio_0 has no interrupt", " no_interrupt+0x"});
  warns("uncleared", {"/dev/uio0 interrupts again, and the application has not accessed axi_dma_0",
                      " uncleared+0x"});
  warns("constant_address",
        {"a DMA reads 0x18000000, which is no memory of the application's",
         "/dev/udmabuf0 has 1048576 bytes at 0x10", "set linux.udmabuf_address=0x18000000"});
  const kit::Outcome owned =
      run(arguments("constant_address", {"--set", "linux.udmabuf_address=0x18000000"}));
  BOOST_TEST(owned.err.find("no memory of the application's") == std::string::npos, owned.err);
  warns("beyond", {"MM2S transfer of 128 bytes at 0x80000000 leaves the memory", " beyond+0x"});
}

BOOST_AUTO_TEST_CASE(it_dies) {
  stops("null_pointer",
        {"ended by SIGSEGV", "access to 0x00000008, a null pointer", " null_pointer+0x", in_main});
  stops("aborts", {"ended by SIGABRT", " aborts+0x"});
}

BOOST_AUTO_TEST_CASE(it_never_ends) {
  const Arguments soon{"--set", "ps.cpu.timeout=1 ms"};
  stops("endless",
        {"no end within 1 ms", "the last register that it read was axi_gpio_0.GPIO_DATA",
         " endless+0x"},
        soon);
  stops("sleeping", {"none came within 1 ms", " sleeping+0x"}, soon);
  stops("waiting", {"it waits for an interrupt, and none came within 1 ms", " waiting+0x"}, soon);
  stops("masked",
        {"an interrupt of /dev/uio0, which is masked", "write 1 (a uint32_t) to /dev/uio0",
         " masked+0x"},
        soon);
  stops("computing", {"takes the host's time and lets no simulated time pass", " computing+0x"},
        {"--set", "ps.cpu.host_timeout=2 s"});
}

BOOST_AUTO_TEST_CASE(more_than_one) {
  stops("threads", {"a second thread of the application uses its devices", " touch+0x"});
  stops("forks", {"the application and a copy of it, made by fork(), both use its devices",
                  "wait for the end of the copy with waitpid()", " forks+0x"});
  stops("becomes", {"became another program, by exec()"});
  ends(1, "starts",
       {"'sh', which the application started, uses /dev/uio0", "ended with exit code 7"});
}

/// A copy that uses no device could still be about to. The time must be enough to start, on a busy
/// computer, too.
BOOST_AUTO_TEST_CASE(a_copy_that_stays) {
  for (const std::string mistake : {"leaves_a_copy", "leaves_a_copy_late"})
    stops(mistake,
          {"the application's process has ended, and a copy of it that fork() made runs on"},
          {"--set", "ps.cpu.host_timeout=3 s"});
  BOOST_TEST(none_is_left("mistakes"));
}

BOOST_AUTO_TEST_CASE(ctrl_c_leaves_no_process_behind) {
  for (const std::string mistake : {"two_processes", "computing"}) {
    Arguments all = arguments(mistake);
    all.insert(all.begin(), "run");
    kit::ChildProcess run(MARKERVP_EXECUTABLE, all, path());
    const std::string first_line = mistake == "computing" ? "udmabuf0" : "two\n";
    await([&] { return run.ended() || run.out().find(first_line) != std::string::npos; });
    run.send(SIGINT);
    const kit::Outcome outcome = run.wait();
    BOOST_TEST(outcome.exit_code == 130, outcome.err);
    BOOST_TEST(result()["incomplete"] == "interrupted");
  }
  BOOST_TEST(none_is_left("mistakes"));
}

BOOST_AUTO_TEST_CASE(what_is_no_application) {
  refuses({"--linux", "nowhere"}, {"--linux: 'nowhere' cannot be opened: No such file"});
  refuses({"--linux", "."}, {"is no file: name an executable"});
  kit::write_file(*this / "script", "#!/bin/sh\n");
  refuses({"--linux", "script"}, {"may not be executed: chmod +x"});
  using std::filesystem::perms;
  std::filesystem::permissions(*this / "script", perms::owner_all);
  refuses({"--linux", "script"}, {"is no executable of Linux (ELF)", "interpreter"});
  refuses({"--linux", copy("root", perms::set_uid)}, {"is setuid or setgid"});
  std::string bytes = kit::read_file(copy("arm", perms::owner_all));
  bytes[18] = 40;  // e_machine
  kit::write_file(*this / "arm", bytes);
  refuses({"--linux", *this / "arm"}, {"is for ARM, 32 bits", "no cross compiler"});
  bytes[18] = 3;
  bytes[4] = 1;  // EI_CLASS
  kit::write_file(*this / "arm", bytes);
  refuses({"--linux", *this / "arm"}, {"is of 32 bits (gcc -m32), and the shim has 64"});
  bytes = kit::read_file(copy("musl", perms::owner_all));
  const std::string loader = "ld-linux";
  BOOST_TEST_REQUIRE((bytes.find(loader) != std::string::npos));
  kit::write_file(*this / "musl", bytes.replace(bytes.find(loader), loader.size(), "ld-other"));
  refuses({"--linux", *this / "musl"}, {"is linked with another C library than glibc ('/lib"});
}

BOOST_AUTO_TEST_CASE(one_with_capabilities) {
  const std::string file = copy("capable", std::filesystem::perms::owner_all);
  vfs_cap_data capabilities{};
  capabilities.magic_etc = VFS_CAP_REVISION_2 | VFS_CAP_FLAGS_EFFECTIVE;
  capabilities.data[0].permitted = 1u << CAP_SYS_RAWIO;
  if (::setxattr(file.c_str(), "security.capability", &capabilities, XATTR_CAPS_SZ_2, 0) != 0) {
    BOOST_TEST_MESSAGE("this user may give no file capabilities");
    return;
  }
  refuses({"--linux", file}, {"has file capabilities", "this computer's own devices: setcap -r"});
}

BOOST_AUTO_TEST_CASE(a_static_one) {
  const std::string source = *this / "static.c", file = *this / "static";
  kit::write_file(source, "int main(void) { return 0; }\n");
  const kit::Outcome built =
      kit::run_process(MARKERVP_C_COMPILER, {"-static", "-o", file, source}, path());
  BOOST_TEST_REQUIRE(built.exit_code == 0, built.err);
  refuses({"--linux", file}, {"is linked statically", "without -static"});
}

BOOST_AUTO_TEST_CASE(a_truncated_one) {
  const std::string whole = MARKERVP_APPLICATIONS "mistakes", file = *this / "part";
  kit::write_part(whole, file, std::filesystem::file_size(whole) / 2);
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  refuses({"--linux", file}, {"is truncated: build or copy it again"});
}

/// The executable finds the shim beside its own file.
BOOST_AUTO_TEST_CASE(where_no_shim_is_to_be_had) {
  namespace fs = std::filesystem;
  const auto refused = [this](const std::string& folder, const std::string& part) {
    fs::create_directories(*this / (folder + "/bin"));
    fs::copy_file(MARKERVP_EXECUTABLE, *this / (folder + "/bin/markervp"));
    const kit::Outcome outcome =
        kit::run_process(*this / (folder + "/bin/markervp"),
                         {"run", "--linux", MARKERVP_APPLICATIONS "gpio"}, path());
    BOOST_TEST(outcome.exit_code == 2, outcome.err);
    BOOST_TEST((outcome.err.find(part) != std::string::npos), outcome.err);
  };
  fs::create_directories(*this / "a place");
  fs::create_directory_symlink(fs::path(MARKERVP_EXECUTABLE).parent_path().parent_path() / "lib",
                               *this / "a place/lib");
  refused("a place", "has a space or a colon in its path, and LD_PRELOAD takes neither");
  refused("nothing", "no libmarkervp_linux.so in ");
}

/// The application would run without the shim. Where a mount can be made.
BOOST_AUTO_TEST_CASE(a_shim_that_cannot_be_loaded) {
  if (kit::run_process("/bin/sh", {"-c", "unshare -rm true"}, path()).exit_code != 0) return;
  namespace fs = std::filesystem;
  const std::string build = fs::path(MARKERVP_EXECUTABLE).parent_path().parent_path();
  const auto run_in = [&](const std::string& options) {
    const std::string script =
        "mkdir -p here/bin here/lib && cp " MARKERVP_EXECUTABLE " here/bin && mount -t tmpfs -o '" +
        options + "' none here/lib && cp -r " + build +
        "/lib/markervp here/lib && exec here/bin/markervp run --linux " MARKERVP_APPLICATIONS
        "gpio --quiet";
    return kit::run_process("/usr/bin/unshare", {"-rm", "/bin/sh", "-c", script}, path());
  };
  const kit::Outcome refused = run_in("noexec,size=400m");
  BOOST_TEST(refused.exit_code == 2, refused.err);
  BOOST_TEST((refused.err.find("mounted noexec") != std::string::npos), refused.err);
  BOOST_TEST(refused.out == "");
  const kit::Outcome taken = run_in("size=400m");
  BOOST_TEST((taken.err.find("mounted noexec") == std::string::npos), taken.err);
}

/// Where the host has no room for what a run with --linux needs.
BOOST_AUTO_TEST_CASE(no_room) {
  const auto refused = [this](const std::string& before, const Arguments& parts) {
    const kit::Outcome outcome = kit::run_process(
        "/bin/bash",
        {"-c", before + " " MARKERVP_EXECUTABLE " run --linux " MARKERVP_APPLICATIONS "gpio"},
        path());
    BOOST_TEST(outcome.exit_code == 2, outcome.err);
    for (const std::string& part : parts)
      BOOST_TEST((outcome.err.find(part) != std::string::npos), outcome.err);
  };
  refused("TMPDIR=/nonexistent", {"no folder can be made", "let TMPDIR name one that takes files"});
  refused("ulimit -f 100000;", {"shares the DDR as a file", "raise 'ulimit -f'"});
  refused("ulimit -n 150;", {"this shell allows 150 open files", "needs 256", "'ulimit -n 256'"});
  refused("ulimit -n 255;", {"this shell allows 255 open files"});
}

BOOST_AUTO_TEST_CASE(what_does_not_go_together) {
  const std::string gpio = MARKERVP_APPLICATIONS "gpio";
  refuses({"--linux", gpio, "--program", "blink"}, {"--linux with --program"});
  refuses({"--linux", gpio, "--rate", "60"}, {"--linux with --rate"});
  refuses({"--linux", gpio, "--fit", "crop"}, {"--linux with --fit"});
  refuses({"--linux", gpio, "--set", "linux.udmabuf_size=512 MiB"},
          {"do not fit into the DMA memory"});
  const std::string address = "linux.udmabuf_address=", uio = "linux.uio=";
  refuses({"--linux", gpio, "--set", address + "0x18000001"}, {"no multiple of a page"});
  refuses({"--linux", gpio, "--set", address + "0x1FFFF000"},
          {"leave the DDR, 0x00100000 to 0x1FFFFFFF"});
  refuses({"--linux", gpio, "--set", address + "0x10000000"}, {" is in use: take a higher"});
  refuses({"--linux", gpio, "--set", uio + "axi_dma_2"}, {"did you mean 'axi_dma_"});
  refuses({"--linux", gpio, "--set", uio + "axi_dma_0.irq"}, {"axi_dma_0 has mm2s_introut"});
  refuses({"--linux", gpio, "--set", uio + "axi_gpio_0.irq"}, {"has no interrupt at the PS"});
  refuses({"--linux", gpio, "--set", uio + "axi_dma_0, b=axi_dma_0"}, {"61 is taken twice"});
  refuses({"--program", "blink", "--set", "linux.udmabufs=2"}, {"linux.udmabufs"});
}

BOOST_AUTO_TEST_CASE(no_debugger) {
  BOOST_TEST(run(arguments("no_register")).exit_code == 0);
  const kit::Outcome outcome = kit::run_process(MARKERVP_EXECUTABLE, {"debug", "out"}, path());
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST((outcome.err.find("a process of its own") != std::string::npos), outcome.err);
}

// The board says as little; here there is a list.
BOOST_AUTO_TEST_CASE(a_device_that_is_none) {
  const kit::Outcome outcome = run(arguments("no_device"));
  BOOST_TEST(outcome.exit_code == 0);
  BOOST_TEST(outcome.err == "");
  BOOST_TEST((outcome.out.find("linux: /dev/uio9 is not there: those that are stand above\n") !=
              std::string::npos),
             outcome.out);
}

BOOST_AUTO_TEST_SUITE_END()
