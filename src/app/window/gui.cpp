#include "app/window/gui.hpp"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_internal.h>  // closing a popup from outside of it
#include <iterator>

#include "app/window/system_font.hpp"
#include "app/window/theme.hpp"

// Dear ImGui 1.89 renamed the header.
#if __has_include(<backends/imgui_impl_sdl2.h>)
#include <backends/imgui_impl_sdl2.h>
#else
#include <backends/imgui_impl_sdl.h>
#endif
#include <backends/imgui_impl_opengl3.h>

namespace quadrille::app {

namespace {

constexpr double scales[] = {0.75, 1, 1.25, 1.5, 2, 2.5, 3, 4};
constexpr double fontPoints = 15, builtInPoints = 13;

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
    const auto set = [&](ImGuiCol place, const Color& color) {
        style.Colors[place] = ImGui::ColorConvertU32ToFloat4(packed(color));
    };
    set(ImGuiCol_Text, theme.text);
    set(ImGuiCol_TextDisabled, theme.faintText);
    set(ImGuiCol_WindowBg, theme.panel);
    set(ImGuiCol_PopupBg, theme.popup);
    set(ImGuiCol_Border, theme.border);
    set(ImGuiCol_FrameBg, theme.frame);
    set(ImGuiCol_FrameBgHovered, theme.frameHovered);
    set(ImGuiCol_FrameBgActive, theme.frameActive);
    set(ImGuiCol_Header, theme.header);
    set(ImGuiCol_HeaderHovered, theme.headerHovered);
    set(ImGuiCol_HeaderActive, theme.headerActive);
    set(ImGuiCol_Button, theme.button);
    set(ImGuiCol_ButtonHovered, theme.buttonHovered);
    set(ImGuiCol_ButtonActive, theme.buttonActive);
    set(ImGuiCol_TitleBg, theme.title);
    set(ImGuiCol_TitleBgActive, theme.title);
    set(ImGuiCol_ScrollbarBg, theme.panel);
    set(ImGuiCol_CheckMark, theme.accent);
    style.ScaleAllSizes(float(scale));
    ImGui::GetStyle() = style;
}

}  // namespace

Gui::Gui(SdlWindow& window, double scale)
    : window_(window), scale_(scale), font_(findFont(fontFolders()).string()) {
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

bool Gui::closePopup() {
    const int open = ImGui::GetCurrentContext()->OpenPopupStack.Size;
    if (open > 0) ImGui::ClosePopupToLevel(open - 1, true);
    return open > 0;
}

void Gui::changeScale(bool larger) {
    if (larger) {
        const auto next = std::upper_bound(std::begin(scales), std::end(scales), scale_);
        if (next != std::end(scales)) scale_ = *next;
    } else {
        const auto next = std::lower_bound(std::begin(scales), std::end(scales), scale_);
        if (next != std::begin(scales)) scale_ = *std::prev(next);
    }
}

/// Text is as fine as the screen: the font is made for framebuffer pixels and shrunk to points.
void Gui::applyScale() {
    const double ratio = window_.size().pixelRatio();
    const double points = font_.empty() ? builtInPoints : fontPoints;
    const double pixels = std::round(points * scale_ * ratio);
    if (pixels == fontPixels_) return;
    fontPixels_ = pixels;
    ImGuiIO& io = ImGui::GetIO();
    ImFontConfig config;
    config.SizePixels = float(pixels);
    config.PixelSnapH = true;  // stems of equal letters look equal
    io.Fonts->Clear();
    if (font_.empty() ||
        io.Fonts->AddFontFromFileTTF(font_.c_str(), float(pixels), &config) == nullptr) {
        io.Fonts->AddFontDefault(&config);
    }
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
