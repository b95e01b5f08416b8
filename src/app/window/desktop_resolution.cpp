#include "app/window/desktop_resolution.hpp"

#include <cstdlib>

#ifdef __linux__
#include <dlfcn.h>
#endif

namespace quadrille::app {

namespace {

constexpr double usual = 96;

}  // namespace

#ifdef __linux__

// SDL has loaded the library already, and the program does not need it where SDL does not.
double desktopDotsPerInch() {
    struct Display;
    void* const library = dlopen("libX11.so.6", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return usual;
    const auto open = reinterpret_cast<Display* (*)(const char*)>(dlsym(library, "XOpenDisplay"));
    const auto get = reinterpret_cast<char* (*)(Display*, const char*, const char*)>(
        dlsym(library, "XGetDefault"));
    const auto close = reinterpret_cast<int (*)(Display*)>(dlsym(library, "XCloseDisplay"));
    double dots = 0;
    if (open != nullptr && get != nullptr && close != nullptr) {
        if (Display* const display = open(nullptr)) {
            // The text belongs to the display.
            if (const char* const text = get(display, "Xft", "dpi"))
                dots = std::strtod(text, nullptr);
            close(display);
        }
    }
    dlclose(library);
    return dots > 0 ? dots : usual;
}

#else

double desktopDotsPerInch() { return usual; }

#endif

}  // namespace quadrille::app
