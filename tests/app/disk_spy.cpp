// Loaded before the program's libraries: appends to the file $QUADRILLE_SPY what is called, "fsync
// file", "fsync folder" or "rename", one a line.
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

void note(const char* line) {
    const int log = open(std::getenv("QUADRILLE_SPY"), O_WRONLY | O_CREAT | O_APPEND, 0600);
    const ssize_t done = write(log, line, std::strlen(line));
    static_cast<void>(done);
    close(log);
}

}  // namespace

extern "C" int fsync(int descriptor) {
    struct stat state {};
    fstat(descriptor, &state);
    note(S_ISDIR(state.st_mode) ? "fsync folder\n" : "fsync file\n");
    return reinterpret_cast<int (*)(int)>(dlsym(RTLD_NEXT, "fsync"))(descriptor);
}

extern "C" int rename(const char* from, const char* to) {
    note("rename\n");
    return reinterpret_cast<int (*)(const char*, const char*)>(dlsym(RTLD_NEXT, "rename"))(from,
                                                                                           to);
}
