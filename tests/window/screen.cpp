#include "screen.hpp"

#include <X11/Xatom.h>
#include <X11/Xutil.h>
#include <X11/extensions/XTest.h>
#include <X11/keysym.h>
#include <array>
#include <chrono>
#include <cstdlib>
#include <stb_image.h>
#include <thread>

namespace quadrille {

namespace {

constexpr unsigned leftButton = 1, wheelUp = 4, wheelDown = 5;

/// A window may go while it is asked about; the answer is then empty, and no reason to end.
int ignoreErrors(Display*, XErrorEvent*) { return 0; }

std::string onPath(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::string folders = path != nullptr ? path : "/usr/bin";
    for (std::size_t begin = 0; begin <= folders.size();) {
        const std::size_t end = std::min(folders.find(':', begin), folders.size());
        const auto file = std::filesystem::path(folders.substr(begin, end - begin)) / program;
        std::error_code error;
        if (std::filesystem::is_regular_file(file, error)) return file.string();
        begin = end + 1;
    }
    return {};
}

}  // namespace

bool near(const Rgb& a, const Rgb& b, int tolerance) {
    return std::abs(a.r - b.r) <= tolerance && std::abs(a.g - b.g) <= tolerance &&
           std::abs(a.b - b.b) <= tolerance;
}

bool eventually(const std::function<bool()>& condition, Process::Seconds timeout) {
    const auto start = std::chrono::steady_clock::now();
    while (!condition()) {
        if (std::chrono::steady_clock::now() - start > timeout) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
}

Image readPng(const std::filesystem::path& file) {
    Image image;
    int channels = 0;
    stbi_uc* const data = stbi_load(file.c_str(), &image.width, &image.height, &channels, 3);
    if (data == nullptr) return {};
    const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
    for (std::size_t i = 0; i < count; ++i) {
        image.pixels.push_back({data[3 * i], data[3 * i + 1], data[3 * i + 2]});
    }
    stbi_image_free(data);
    return image;
}

std::unique_ptr<Screen> Screen::start(int width, int height) {
    const std::string program = onPath("Xvfb");
    if (program.empty()) return nullptr;
    const std::string size = std::to_string(width) + "x" + std::to_string(height) + "x24";
    // The server chooses a display number that is free and prints it.
    auto server = std::make_unique<Process>(
        program, std::vector<std::string>{"-displayfd", "1", "-screen", "0", size, "-nolisten",
                                          "tcp", "-noreset"});
    if (!server->waitUntil([&] { return server->out().find('\n') != std::string::npos; })) {
        return nullptr;
    }
    const std::string name = ":" + server->out().substr(0, server->out().find('\n'));
    Display* const display = XOpenDisplay(name.c_str());
    if (display == nullptr) return nullptr;
    XSetErrorHandler(ignoreErrors);
    return std::unique_ptr<Screen>(new Screen(std::move(server), name, display));
}

Screen::Screen(std::unique_ptr<Process> server, std::string name, Display* display)
    : server_(std::move(server)), name_(std::move(name)), display_(display) {}

Screen::~Screen() { XCloseDisplay(display_); }

Window Screen::window() {
    Window root = 0, parent = 0, *children = nullptr;
    unsigned count = 0;
    if (XQueryTree(display_, DefaultRootWindow(display_), &root, &parent, &children, &count) == 0) {
        return 0;
    }
    Window found = 0;
    for (unsigned i = 0; i < count; ++i) {
        XWindowAttributes attributes{};
        if (XGetWindowAttributes(display_, children[i], &attributes) != 0 &&
            attributes.map_state == IsViewable && attributes.c_class == InputOutput) {
            found = children[i];
        }
    }
    if (children != nullptr) XFree(children);
    return found;
}

std::string Screen::title() {
    XTextProperty property{};
    const Window target = window();
    if (target == 0 || XGetWMName(display_, target, &property) == 0) return {};
    std::string title;
    if (property.value != nullptr) {
        title = reinterpret_cast<const char*>(property.value);
        XFree(property.value);
    }
    return title;
}

Image Screen::image() {
    const Window root = DefaultRootWindow(display_);
    const int screen = DefaultScreen(display_);
    Image image{DisplayWidth(display_, screen), DisplayHeight(display_, screen), {}};
    XImage* const x = XGetImage(display_, root, 0, 0, unsigned(image.width), unsigned(image.height),
                                AllPlanes, ZPixmap);
    if (x == nullptr) return {};
    image.pixels.reserve(std::size_t(image.width) * std::size_t(image.height));
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            const unsigned long p = XGetPixel(x, column, row);
            image.pixels.push_back({int(p >> 16 & 255), int(p >> 8 & 255), int(p & 255)});
        }
    }
    XDestroyImage(x);
    return image;
}

void Screen::wantDotsPerInch(int dots) {
    const std::string text = "Xft.dpi:\t" + std::to_string(dots) + "\n";
    XChangeProperty(display_, DefaultRootWindow(display_), XA_RESOURCE_MANAGER, XA_STRING, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(text.data()),
                    int(text.size()));
    XSync(display_, False);
}

void Screen::moveMouse(int x, int y) {
    XTestFakeMotionEvent(display_, -1, x, y, CurrentTime);
    XSync(display_, False);
}

void Screen::click(int x, int y) {
    moveMouse(x, y);
    XTestFakeButtonEvent(display_, leftButton, True, CurrentTime);
    XTestFakeButtonEvent(display_, leftButton, False, CurrentTime);
    XSync(display_, False);
}

void Screen::drag(int fromX, int fromY, int toX, int toY, Process::Seconds pause) {
    moveMouse(fromX, fromY);
    std::this_thread::sleep_for(pause);
    XTestFakeButtonEvent(display_, leftButton, True, CurrentTime);
    XSync(display_, False);
    std::this_thread::sleep_for(pause);
    moveMouse((fromX + toX) / 2, (fromY + toY) / 2);
    std::this_thread::sleep_for(pause);
    moveMouse(toX, toY);
    std::this_thread::sleep_for(pause);
    XTestFakeButtonEvent(display_, leftButton, False, CurrentTime);
    XSync(display_, False);
}

void Screen::wheel(int x, int y, int notches) {
    moveMouse(x, y);
    const unsigned button = notches > 0 ? wheelUp : wheelDown;
    for (int i = 0; i < std::abs(notches); ++i) {
        XTestFakeButtonEvent(display_, button, True, CurrentTime);
        XTestFakeButtonEvent(display_, button, False, CurrentTime);
    }
    XSync(display_, False);
}

void Screen::press(const std::string& key) {
    const KeyCode code = XKeysymToKeycode(display_, XStringToKeysym(key.c_str()));
    XTestFakeKeyEvent(display_, code, True, CurrentTime);
    XTestFakeKeyEvent(display_, code, False, CurrentTime);
    XSync(display_, False);
}

void Screen::focus() {
    XSetInputFocus(display_, window(), RevertToParent, CurrentTime);
    XSync(display_, False);
}

void Screen::resize(int width, int height) {
    XMoveResizeWindow(display_, window(), 0, 0, unsigned(width), unsigned(height));
    XSync(display_, False);
}

namespace {

void sendMessage(Display* display, Window target, const char* type, std::array<long, 5> data) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = XInternAtom(display, type, False);
    event.xclient.format = 32;
    for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i] = data[i];
    XSendEvent(display, target, False, NoEventMask, &event);
    XSync(display, False);
}

/// Hands the dropped file's address to whoever asks for the selection.
void answer(Display* display, const XSelectionRequestEvent& request, const std::string& address) {
    XChangeProperty(display, request.requestor, request.property, request.target, 8,
                    PropModeReplace, reinterpret_cast<const unsigned char*>(address.data()),
                    int(address.size()));
    XEvent event{};
    event.xselection.type = SelectionNotify;
    event.xselection.requestor = request.requestor;
    event.xselection.selection = request.selection;
    event.xselection.target = request.target;
    event.xselection.property = request.property;
    event.xselection.time = request.time;
    XSendEvent(display, request.requestor, False, NoEventMask, &event);
    XSync(display, False);
}

}  // namespace

bool Screen::asksForFullScreen(const std::string& key, bool full) {
    // What is sent to the root window reaches who looks after its children.
    XSelectInput(display_, DefaultRootWindow(display_),
                 SubstructureNotifyMask | SubstructureRedirectMask);
    const Atom state = XInternAtom(display_, "_NET_WM_STATE", False);
    const auto fullScreen =
        static_cast<long>(XInternAtom(display_, "_NET_WM_STATE_FULLSCREEN", False));
    press(key);
    bool asked = false;
    eventually([&] {
        while (XPending(display_) > 0) {
            XEvent event{};
            XNextEvent(display_, &event);
            if (event.type != ClientMessage || event.xclient.message_type != state) continue;
            const auto& data = event.xclient.data.l;
            asked |= data[0] == long(full) && data[1] == fullScreen;
        }
        return asked;
    });
    XSelectInput(display_, DefaultRootWindow(display_), NoEventMask);
    XSync(display_, True);
    return asked;
}

void Screen::close() {
    const auto quit = static_cast<long>(XInternAtom(display_, "WM_DELETE_WINDOW", False));
    sendMessage(display_, window(), "WM_PROTOCOLS", {quit, CurrentTime, 0, 0, 0});
}

bool Screen::drop(const std::filesystem::path& file, Process::Seconds timeout) {
    const auto atom = [&](const char* name) { return XInternAtom(display_, name, False); };
    const Window source =
        XCreateSimpleWindow(display_, DefaultRootWindow(display_), -10, -10, 1, 1, 0, 0, 0);
    const auto self = static_cast<long>(source);
    XSetSelectionOwner(display_, atom("XdndSelection"), source, CurrentTime);
    const Window target = window();
    constexpr long version5 = 5L << 24;
    const auto type = static_cast<long>(atom("text/uri-list"));
    sendMessage(display_, target, "XdndEnter", {self, version5, type, 0, 0});
    const auto copy = static_cast<long>(atom("XdndActionCopy"));
    sendMessage(display_, target, "XdndPosition", {self, 0, 640L << 16 | 360, CurrentTime, copy});
    const std::string address = "file://" + file.string() + "\r\n";
    bool dropped = false, finished = false;
    eventually(
        [&] {
            while (XPending(display_) > 0) {
                XEvent event{};
                XNextEvent(display_, &event);
                if (event.type == SelectionRequest) {
                    answer(display_, event.xselectionrequest, address);
                } else if (event.type == ClientMessage &&
                           event.xclient.message_type == atom("XdndStatus") && !dropped) {
                    dropped = true;
                    sendMessage(display_, target, "XdndDrop", {self, 0, CurrentTime, 0, 0});
                } else if (event.type == ClientMessage &&
                           event.xclient.message_type == atom("XdndFinished")) {
                    finished = true;
                }
            }
            return finished;
        },
        timeout);
    XDestroyWindow(display_, source);
    return finished;
}

}  // namespace quadrille
