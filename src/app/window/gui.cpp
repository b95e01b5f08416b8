#include "app/window/gui.hpp"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <imgui.h>
#include <iterator>

// Dear ImGui 1.89 renamed the header.
#if __has_include(<backends/imgui_impl_sdl2.h>)
#include <backends/imgui_impl_sdl2.h>
#else
#include <backends/imgui_impl_sdl.h>
#endif
#include <backends/imgui_impl_opengl3.h>

namespace quadrille::app {

namespace {

constexpr double scales[] = {1, 1.25, 1.5, 2, 2.5, 3};
constexpr double fontPoints = 13;

void applyStyle(double scale) {
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.WindowBorderSize = 1;
    style.WindowPadding = {10, 7};
    style.FramePadding = {4, 2};
    style.ItemSpacing = {7, 3};
    style.CellPadding = {4, 1};
    style.Colors[ImGuiCol_WindowBg] = {0.085f, 0.100f, 0.120f, 1};
    style.Colors[ImGuiCol_Border] = {0.22f, 0.25f, 0.29f, 1};
    style.Colors[ImGuiCol_FrameBg] = {0.16f, 0.19f, 0.23f, 1};
    style.Colors[ImGuiCol_Header] = {0.17f, 0.26f, 0.36f, 1};
    style.Colors[ImGuiCol_Button] = {0.19f, 0.30f, 0.42f, 1};
    style.Colors[ImGuiCol_TextDisabled] = {0.60f, 0.65f, 0.71f, 1};
    style.ScaleAllSizes(float(scale));
    ImGui::GetStyle() = style;
}

}  // namespace

Gui::Gui(SdlWindow& window) : window_(window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // the panels stay where they are: there is nothing to remember
    ImGui_ImplSDL2_InitForOpenGL(window.handle(), window.context());
    ImGui_ImplOpenGL3_Init("#version 330 core");
    applyScale();
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplSDL2_Shutdown();
    ImGui::DestroyContext();
}

void Gui::processEvent(const SDL_Event& event) { ImGui_ImplSDL2_ProcessEvent(&event); }

bool Gui::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }
bool Gui::wantsKeyboard() const { return ImGui::GetIO().WantCaptureKeyboard; }

void Gui::changeScale(bool larger) {
    const auto now = std::find(std::begin(scales), std::end(scales), scale_);
    if (larger && std::next(now) != std::end(scales)) scale_ = *std::next(now);
    if (!larger && now != std::begin(scales)) scale_ = *std::prev(now);
}

/// Text is as fine as the screen: the font is made for framebuffer pixels and shrunk to points.
void Gui::applyScale() {
    const double ratio = window_.size().pixelRatio();
    const double pixels = std::round(fontPoints * scale_ * ratio);
    if (pixels == fontPixels_) return;
    fontPixels_ = pixels;
    ImGuiIO& io = ImGui::GetIO();
    ImFontConfig config;
    config.SizePixels = float(pixels);
    io.Fonts->Clear();
    io.Fonts->AddFontDefault(&config);
    io.FontGlobalScale = float(1 / ratio);
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
    applyStyle(scale_);
}

void Gui::beginFrame() {
    applyScale();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplSDL2_NewFrame();
    ImGui::NewFrame();
}

void Gui::endFrame() { ImGui::Render(); }

void Gui::draw() { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

}  // namespace quadrille::app
