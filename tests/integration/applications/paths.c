/* The ways to come to a device file and its sysfs. Ends with 0 if all lead there. */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <glob.h>
#include <limits.h>
#include <linux/openat2.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#define EXPECT(condition)                                           \
  do {                                                              \
    if (condition) break;                                           \
    printf("%s:%d: not so: %s\n", "paths.c", __LINE__, #condition); \
    exit(1);                                                        \
  } while (0)

/* It is uio0, of AXI DMA 0. */
static void check(int file, const char* path) {
  if (file < 0) perror(path);
  EXPECT(file >= 0);
  volatile uint32_t* dma = mmap(NULL, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  EXPECT(dma != MAP_FAILED);
  EXPECT((dma[1] & 1) == 1); /* halted */
  struct stat status;
  EXPECT(fstat(file, &status) == 0 && S_ISCHR(status.st_mode));
  EXPECT(munmap((void*)dma, 4096) == 0);
  EXPECT(close(file) == 0);
}

static void check_name(int file) {
  char text[64] = "";
  EXPECT(file >= 0);
  EXPECT(read(file, text, sizeof text - 1) > 0 && strcmp(text, "dma\n") == 0);
  EXPECT(close(file) == 0);
}

static void written(void) {
  const char* const ways[] = {"/dev/uio0",
                              "/dev//uio0",
                              "//dev/./uio0",
                              "/dev/../dev/uio0",
                              "/sys/class/uio/uio0/../../../../dev/uio0",
                              "/proc/self/root/dev/uio0"};
  for (unsigned i = 0; i < sizeof ways / sizeof *ways; ++i) {
    check(open(ways[i], O_RDWR), ways[i]);
    check(open64(ways[i], O_RDWR), ways[i]);
    check(openat(AT_FDCWD, ways[i], O_RDWR), ways[i]);
    check(openat(77, ways[i], O_RDWR), ways[i]);
    EXPECT(access(ways[i], R_OK | W_OK) == 0);
  }
  check_name(open("/sys/class//uio/uio0/name", O_RDONLY));
  EXPECT(open("/dev/uio", O_RDWR) == -1 && errno == ENOENT);
  EXPECT(open("/dev/uio0x", O_RDWR) == -1 && errno == ENOENT);
  EXPECT(open("/dev/nothing/../uio7", O_RDWR) == -1 && errno == ENOENT);
}

static void relative(void) {
  char before[PATH_MAX], now[PATH_MAX];
  EXPECT(getcwd(before, sizeof before) != NULL);
  EXPECT(chdir("/dev") == 0);
  check(open("uio0", O_RDWR), "uio0");
  check(open("./uio0", O_RDWR), "./uio0");
  EXPECT(access("uio0", F_OK) == 0 && access("null", W_OK) == 0);
  EXPECT(chdir("/sys/class/uio/uio0") == 0);
  EXPECT(getcwd(now, sizeof now) != NULL && strcmp(now, "/sys/class/uio/uio0") == 0);
  char* const name = get_current_dir_name();
  EXPECT(name != NULL && strcmp(name, now) == 0);
  free(name);
  check_name(open("name", O_RDONLY));
  check_name(open("../uio0/name", O_RDONLY));
  check(open("../../../../dev/uio0", O_RDWR), "../../../../dev/uio0");
  const int host = open("../../../../etc/hostname", O_RDONLY);
  EXPECT(host >= 0 || access("/etc/hostname", R_OK) != 0);
  close(host);
  EXPECT(chdir(before) == 0);
}

static void by_descriptor(void) {
  const int dev = open("/dev", O_RDONLY | O_DIRECTORY), class = open("/sys/class/uio", O_RDONLY);
  EXPECT(dev >= 0 && class >= 0);
  check(openat(dev, "uio0", O_RDWR), "openat uio0");
  check(openat64(dev, "uio0", O_RDWR), "openat64 uio0");
  check(openat(class, "../../../dev/uio0", O_RDWR), "openat ../../../dev/uio0");
  check_name(openat(class, "uio0/name", O_RDONLY));
  const int nothing = openat(dev, "null", O_WRONLY);
  EXPECT(nothing >= 0 && write(nothing, "", 1) == 1);
  close(nothing);
  EXPECT(faccessat(dev, "uio0", R_OK, 0) == 0 && faccessat(dev, "uio9", R_OK, 0) == -1);
  struct stat status;
  EXPECT(fstatat(dev, "uio0", &status, 0) == 0 && S_ISCHR(status.st_mode));
  EXPECT(fstatat(dev, "null", &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISCHR(status.st_mode));
  EXPECT(fchdir(dev) == 0);
  check(open("uio0", O_RDWR), "uio0 after fchdir");
  EXPECT(chdir("/") == 0);
  check(open("dev/uio0", O_RDWR), "dev/uio0");
  close(dev);
  close(class);
}

static void linked(const char* folder) {
  char device[PATH_MAX], link[PATH_MAX], text[PATH_MAX];
  snprintf(device, sizeof device, "%s/camera", folder);
  snprintf(link, sizeof link, "%s/devices", folder);
  EXPECT(symlink("/dev/uio0", device) == 0 && symlink("/dev", link) == 0);
  check(open(device, O_RDWR), device);
  struct stat status;
  EXPECT(stat(device, &status) == 0 && S_ISCHR(status.st_mode));
  EXPECT(lstat(device, &status) == 0 && S_ISLNK(status.st_mode));
  EXPECT(open(device, O_RDWR | O_NOFOLLOW) == -1 && errno == ELOOP);
  EXPECT(readlink(device, text, sizeof text) == 9 && memcmp(text, "/dev/uio0", 9) == 0);
  EXPECT(realpath(device, text) == text && strcmp(text, "/dev/uio0") == 0);
  snprintf(device, sizeof device, "%s/devices/uio0", folder);
  check(open(device, O_RDWR), device);
  EXPECT(access(device, F_OK) == 0);
}

static void status_of(const char* path, unsigned expected_major, unsigned expected_minor) {
  struct stat one, two;
  struct stat64 three;
  struct statx four;
  EXPECT(stat(path, &one) == 0 && lstat(path, &two) == 0 && stat64(path, &three) == 0);
  EXPECT(statx(AT_FDCWD, path, 0, STATX_BASIC_STATS, &four) == 0);
  EXPECT(S_ISCHR(one.st_mode) && S_ISCHR(two.st_mode) && S_ISCHR(three.st_mode));
  EXPECT(S_ISCHR(four.stx_mode) && four.stx_rdev_minor == expected_minor);
  EXPECT(one.st_rdev == two.st_rdev && one.st_rdev == three.st_rdev);
  EXPECT(expected_major == 0 || major(one.st_rdev) == expected_major);
  EXPECT(minor(one.st_rdev) == expected_minor && major(one.st_rdev) == four.stx_rdev_major);
}

static void statuses(void) {
  status_of("/dev/mem", 1, 1);
  status_of("/dev//uio1", 0, 1);
  status_of("/dev/./udmabuf0", 0, 0);
  struct stat status;
  struct statx more;
  EXPECT(stat("/dev/uio9", &status) == -1 && errno == ENOENT);
  EXPECT(stat("/sys/class/uio/uio0", &status) == 0 && S_ISDIR(status.st_mode));
  EXPECT(stat("/sys/class/uio/uio9", &status) == -1 && errno == ENOENT);
  EXPECT(stat("/dev", &status) == 0 && S_ISDIR(status.st_mode));
  const int file = open("/dev/uio1", O_RDWR);
  EXPECT(fstatat(file, "", &status, AT_EMPTY_PATH) == 0 && minor(status.st_rdev) == 1);
  EXPECT(statx(file, "", AT_EMPTY_PATH, STATX_BASIC_STATS, &more) == 0 && S_ISCHR(more.stx_mode));
  EXPECT(euidaccess("/dev/uio1", R_OK) == 0 && eaccess("/dev/uio1", R_OK) == 0);
  char text[PATH_MAX];
  EXPECT(realpath("/dev/../dev//uio1", text) == text && strcmp(text, "/dev/uio1") == 0);
  EXPECT(realpath("/sys/class/udmabuf/udmabuf0", text) == text &&
         strcmp(text, "/sys/class/u-dma-buf/udmabuf0") == 0);
  EXPECT(realpath("/dev/uio9", text) == NULL && errno == ENOENT);
  char* const name = canonicalize_file_name("/dev//mem");
  EXPECT(name != NULL && strcmp(name, "/dev/mem") == 0);
  free(name);
  EXPECT(readlinkat(AT_FDCWD, "/sys/class/udmabuf", text, sizeof text) == 9);
}

static unsigned count_in(const char* path, const char* begin, int type) {
  DIR* const folder = opendir(path);
  EXPECT(folder != NULL);
  unsigned found = 0;
  for (struct dirent* entry; (entry = readdir(folder));) {
    if (strncmp(entry->d_name, begin, strlen(begin)) != 0) continue;
    ++found;
    EXPECT(type == DT_UNKNOWN || entry->d_type == type);
  }
  closedir(folder);
  return found;
}

static int is_uio(const struct dirent* entry) {
  return strncmp(entry->d_name, "uio", 3) == 0 && entry->d_type == DT_CHR;
}

static int is_uio64(const struct dirent64* entry) {
  return strncmp(entry->d_name, "uio", 3) == 0;
}

static void release(void** entries, int count) {
  for (int i = 0; i < count; ++i) free(entries[i]);
  free(entries);
}

static unsigned globbed(const char* pattern, int flags, const char* first) {
  glob_t found;
  memset(&found, 0, sizeof found);
  const int code = glob(pattern, flags, NULL, &found);
  if (code == GLOB_NOMATCH) return 0;
  EXPECT(code == 0 && found.gl_pathc > 0);
  EXPECT(first == NULL || strcmp(found.gl_pathv[0], first) == 0);
  const unsigned count = (unsigned)found.gl_pathc;
  globfree(&found);
  return count;
}

static void listed(void) {
  EXPECT(count_in("/dev", "uio", DT_CHR) == 4 && count_in("/dev", "mem", DT_CHR) == 1);
  EXPECT(count_in("/dev/", "udmabuf", DT_CHR) == 1 && count_in("/dev", "null", DT_UNKNOWN) == 1);
  EXPECT(count_in("/sys/class", "uio", DT_DIR) == 1);
  EXPECT(count_in("/sys/class", "u-dma-buf", DT_DIR) == 1);
  EXPECT(count_in("/sys//class/uio/", "uio", DT_DIR) == 4);
  EXPECT(chdir("/dev") == 0 && count_in(".", "uio", DT_CHR) == 4);
  struct dirent** entries = NULL;
  EXPECT(scandir("/dev", &entries, is_uio, alphasort) == 4);
  EXPECT(strcmp(entries[0]->d_name, "uio0") == 0 && strcmp(entries[1]->d_name, "uio1") == 0);
  release((void**)entries, 4);
  struct dirent64** more = NULL;
  EXPECT(scandir64("/sys/class/uio", &more, is_uio64, alphasort64) == 4);
  release((void**)more, 4);
  EXPECT(scandir("/dev/nothing", &entries, NULL, NULL) == -1 && errno == ENOENT);
  EXPECT(globbed("/dev/uio*", 0, "/dev/uio0") == 4 &&
         globbed("/dev/uio[1-9]", 0, "/dev/uio1") == 3);
  EXPECT(globbed("/sys/class/uio/uio*/name", 0, "/sys/class/uio/uio0/name") == 4);
  EXPECT(globbed("/sys/class/uio/*/maps/map*/addr", 0, NULL) == 4);
  EXPECT(globbed("/sys/class/ui*", GLOB_MARK, "/sys/class/uio/") == 1);
  EXPECT(globbed("uio*", 0, "uio0") == 4 && globbed("/dev/uio9*", 0, NULL) == 0);
  EXPECT(globbed("/dev/nul?", 0, "/dev/null") == 1);
  DIR* const folder = opendir("/dev");
  EXPECT(folder != NULL);
  check(openat(dirfd(folder), "uio0", O_RDWR), "of a listed folder");
  closedir(folder);
  FILE* const file = fopen("../sys/class/uio/uio0/name", "r");
  char text[64] = "";
  EXPECT(file != NULL && fgets(text, sizeof text, file) && strcmp(text, "dma\n") == 0);
  fclose(file);
}

/* Without the functions of the C library. */
static void by_system_call(void) {
  check((int)syscall(SYS_openat, AT_FDCWD, "/dev/uio0", O_RDWR), "by syscall(SYS_openat)");
  check((int)syscall(SYS_open, "/dev//uio0", O_RDWR), "by syscall(SYS_open)");
  struct open_how how;
  memset(&how, 0, sizeof how);
  how.flags = O_RDWR;
  check((int)syscall(SYS_openat2, AT_FDCWD, "/dev/uio0", &how, sizeof how),
        "by syscall(SYS_openat2)");
  struct stat status;
  EXPECT(syscall(SYS_stat, "/dev/uio0", &status) == 0 && S_ISCHR(status.st_mode));
  EXPECT(syscall(SYS_access, "/dev/uio9", F_OK) == -1 && errno == ENOENT);
  EXPECT(syscall(SYS_faccessat, AT_FDCWD, "/dev/uio9", F_OK) == -1 && errno == ENOENT);
  struct statx extended;
  EXPECT(syscall(SYS_statx, AT_FDCWD, "/dev/uio0", 0, STATX_BASIC_STATS, &extended) == 0 &&
         S_ISCHR(extended.stx_mode));
  const int first = open("/dev/uio0", O_RDWR);
  const int second = (int)syscall(SYS_dup2, first, first + 20);
  EXPECT(second == first + 20 && syscall(SYS_dup3, first, second, O_CLOEXEC) == second);
  EXPECT(close(first) == 0);
  check(second, "by syscall(SYS_dup2)");
  EXPECT(syscall(SYS_getpid) == getpid());
}

int main(int count, char** words) {
  EXPECT(count == 2);
  written();
  relative();
  by_descriptor();
  linked(words[1]);
  statuses();
  listed();
  by_system_call();
  return 0;
}
