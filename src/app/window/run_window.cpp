#include "app/window/run_window.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <epoxy/gl.h>
#include <exception>
#include <numeric>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/interrupt.hpp"
#include "app/window/body_colors.hpp"
#include "app/window/box_layer.hpp"
#include "app/window/cell_layer.hpp"
#include "app/window/comparison_layer.hpp"
#include "app/window/comparison_view.hpp"
#include "app/window/gui.hpp"
#include "app/window/input.hpp"
#include "app/window/overlay.hpp"
#include "app/window/panels.hpp"
#include "app/window/recording.hpp"
#include "app/window/screenshot.hpp"
#include "app/window/sdl_window.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"
#include "app/window/trail_lines.hpp"

namespace quadrille::app {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Seconds between two pictures at least: with vsync the screen sets the pace, and this only stops
/// a driver that does not wait.
constexpr double withVsync = 1.0 / 240, withoutVsync = 1.0 / 60;

/// Pictures that the panels may need to react to an input.
constexpr int settlingPictures = 4;
constexpr int restMilliseconds = 200;

constexpr double pageZoom = 1.25;

class WindowRun {
  public:
    explicit WindowRun(const Options& options);
    int loop();

  private:
    void takeEvents();
    void beginPanels();
    void wait();
    void moveCamera();
    void showPicture(bool last);
    void prepare(const Viewport& viewport);
    void draw(const Viewport& viewport) const;
    void takeScreenshots(bool last);
    template <class Write>
    void tryToWrite(Write&& write);
    void finishPhase(ShowPhase phase);
    void countPicture();
    void recordPhases(double pictureSeconds);
    void updateTitle();
    void setViewport(const Viewport& viewport) const;
    ScreenRect rect() const { return worldRect(view_, gui_.scale(), size_.width, size_.height); }
    /// Where worlds are shown.
    std::vector<ScreenRect> views() const;
    /// Of the second run.
    Viewport secondViewport() const { return {view_.camera, views()[1], size_.pixelRatio()}; }

    const Options& options_;
    Workbench bench_;  // first, so that a bad scene opens no window
    ViewState view_;
    SdlWindow window_;
    Gui gui_;
    BoxLayer boxes_;
    CellLayer cells_;
    BodyColors colors_;
    std::optional<ComparisonLayer> comparison_;
    std::optional<Recording> film_;
    std::exception_ptr failure_;  // of writing pictures
    Input input_;
    std::vector<SDL_Event> events_;  // of this picture
    Measures measures_;
    PhaseHistory history_;
    ErrorHistory errors_;

    SdlWindow::Size size_;
    bool fullScreen_ = false;
    bool vsync_ = false, hasVsync_ = false;  // what was asked for, and what the driver does
    Clock::time_point pictureStart_, phaseStart_;
    std::array<double, showPhaseCount> phases_{};  // s, of this picture
    double waited_ = 0;                            // s, after this picture
    bool shownOne_ = false;
    std::uint64_t runVersion_ = 0, cellsVersion_ = 0, stepsShown_ = 0;  // of what the layers hold
    int idlePictures_ = 0;                                              // since the last event
    ColorBy colorBy_ = ColorBy::Entity;
    Clock::time_point titleTime_;
};

WindowRun::WindowRun(const Options& options)
    : options_(options),
      bench_(options),
      window_(options.window.size, options.window.scale, options.window.offscreen),
      gui_(window_, window_.scale()),
      size_(window_.size()) {
    view_.overlays = options.window.overlays;
    view_.colorBy = options.window.colorBy;
    view_.vsync = options.window.vsync;
    view_.panels = options.window.panels;
    if (options.beside) comparison_.emplace();
    if (!options.window.video.empty()) {
        film_.emplace(options, size_);
        view_.vsync = false;  // the film sets the pace
    }
    vsync_ = view_.vsync;
    hasVsync_ = window_.setVsync(vsync_);
    bench_.watchContacts(view_.overlays.contacts);
    bench_.watchTrails(view_.overlays.trails);
    bench_.watchHits(view_.colorBy == ColorBy::SinceHit);
    bench_.session().statistics().shown = Shown{
        .width = size_.pixelWidth, .height = size_.pixelHeight, .renderer = window_.renderer()};
}

int WindowRun::loop() {
    catchInterrupts();
    pictureStart_ = Clock::now();
    while (true) {
        const double elapsed = secondsSince(pictureStart_);
        pictureStart_ = Clock::now();
        recordPhases(elapsed);
        takeEvents();
        beginPanels();
        view_.timeline = bench_.keepsPast();
        if (comparison_) {
            view_.compared = bench_.simulation().world().config().size;
            view_.colorBy = ColorBy::Entity;  // colours say which bodies are wrong
        }
        for (const SDL_Event& event : events_) input_.handle(event, views(), gui_, bench_, view_);
        bench_.advance(film_ ? film_->secondsSinceLast() : elapsed);
        const RunSession& session = bench_.session();
        const bool last =
            view_.quit || interruptedBy() != 0 || session.allFramesDone() || session.timeIsUp();
        showPicture(last);
        if (last || failure_) break;
        if (!film_ || bench_.paused()) wait();
    }
    tryToWrite([&] {
        if (film_) film_->commit();
    });
    const int code = bench_.session().finish();
    if (failure_) std::rethrow_exception(failure_);
    return code;
}

/// What cannot be written of the pictures ends the run, whose other outputs are written all the
/// same.
template <class Write>
void WindowRun::tryToWrite(Write&& write) {
    if (failure_) return;
    try {
        write();
    } catch (const Error&) {
        failure_ = std::current_exception();
    }
}

void WindowRun::wait() {
    if (bench_.speed() == 0 && !bench_.paused()) return;
    const auto before = Clock::now();
    const double interval = hasVsync_ ? withVsync : withoutVsync;
    std::this_thread::sleep_until(pictureStart_ + std::chrono::duration_cast<Clock::duration>(
                                                      std::chrono::duration<double>(interval)));
    // Nothing moves, and the panels have settled: rest until the user does something.
    const bool resting = bench_.paused() && ++idlePictures_ > settlingPictures;
    if (resting) SDL_WaitEventTimeout(nullptr, restMilliseconds);
    waited_ = secondsSince(before);
}

/// The panels say whose the mouse is, for one place of it in a picture: what happens after it has
/// moved from the place of a click waits for the next. So does the end of a key while they edit a
/// text, since they look at which keys are down.
void WindowRun::takeEvents() {
    events_.clear();
    SDL_PumpEvents();
    bool used = false, typed = false;
    SDL_Event event;
    while (SDL_PeepEvents(&event, 1, SDL_PEEKEVENT, SDL_FIRSTEVENT, SDL_LASTEVENT) > 0) {
        if (used && event.type == SDL_MOUSEMOTION) break;
        if (typed && event.type == SDL_KEYUP) break;
        if (SDL_PollEvent(&event) == 0) break;
        used |= event.type == SDL_MOUSEBUTTONDOWN || event.type == SDL_MOUSEBUTTONUP ||
                event.type == SDL_MOUSEWHEEL;
        typed |= event.type == SDL_KEYDOWN && gui_.wantsKeyboard();
        events_.push_back(event);
        gui_.processEvent(event);
    }
    if (!events_.empty()) idlePictures_ = 0;
    size_ = window_.size();
}

void WindowRun::beginPanels() {
    phaseStart_ = Clock::now();
    for (; view_.scaleSteps != 0; view_.scaleSteps -= view_.scaleSteps > 0 ? 1 : -1) {
        gui_.changeScale(view_.scaleSteps > 0);
    }
    if (view_.vsync != vsync_) {
        vsync_ = view_.vsync;
        hasVsync_ = window_.setVsync(vsync_);
        if (vsync_ && !hasVsync_) bench_.say("this driver has no vsync");
    }
    if (view_.fullScreen != fullScreen_) {
        fullScreen_ = view_.fullScreen;
        if (!window_.setFullScreen(fullScreen_)) bench_.say("this screen has no full screen");
    }
    gui_.beginFrame();
    finishPhase(ShowPhase::Gui);
}

void WindowRun::moveCamera() {
    if (view_.zoomSteps != 0) {
        view_.zoomAt(rect().center(), std::pow(pageZoom, view_.zoomSteps), rect());
        view_.zoomSteps = 0;
    }
    const World& world = bench_.simulation().world();
    if (bench_.following()) {
        view_.camera.center = world.get<Transform>(*bench_.selected()).position;
        view_.fit = false;
    } else if (view_.fit) {
        const Vec2 half = world.config().size / 2;
        view_.camera.fit({-half, half}, rect());
    }
}

/// Ends a phase of showing a picture. With --profile it lasts until the driver has done its work;
/// otherwise that may come later, in `present`.
void WindowRun::finishPhase(ShowPhase phase) {
    if (options_.profile && phase != ShowPhase::Prepare) glFinish();
    const auto now = Clock::now();
    phases_[static_cast<std::size_t>(phase)] +=
        std::chrono::duration<double>(now - phaseStart_).count();
    phaseStart_ = now;
}

std::vector<ScreenRect> WindowRun::views() const {
    if (!comparison_) return {rect()};
    const auto both = comparisonLayout(view_, gui_.scale(), size_.width, size_.height).views;
    return {both.begin(), both.end()};
}

void WindowRun::showPicture(bool last) {
    errors_.update(bench_);
    phaseStart_ = Clock::now();
    moveCamera();
    measures_.update(bench_);
    const PanelContext context{bench_,  view_,        measures_,   history_,
                               errors_, gui_.scale(), size_.width, size_.height};
    showPanels(context);
    finishPhase(ShowPhase::Gui);

    const Viewport viewport{view_.camera, rect(), size_.pixelRatio()};
    prepare(viewport);
    finishPhase(ShowPhase::Prepare);
    showTrails(context);
    showOverlay(context, colors_.scale());
    if (comparison_) showComparison(context);
    gui_.endFrame();
    finishPhase(ShowPhase::Gui);
    draw(viewport);
    finishPhase(ShowPhase::Draw);
    glViewport(0, 0, size_.pixelWidth, size_.pixelHeight);
    gui_.draw();
    finishPhase(ShowPhase::Gui);
    tryToWrite([&] {
        takeScreenshots(last);
        if (film_ && !bench_.paused()) film_->add(bench_.session(), size_);
    });
    updateTitle();
    phaseStart_ = Clock::now();
    window_.present();
    finishPhase(ShowPhase::Present);
    countPicture();
}

void WindowRun::prepare(const Viewport& viewport) {
    const Simulation& simulation = bench_.simulation();
    boxes_.prepare(simulation.world(), viewport);
    const bool otherRun = runVersion_ != bench_.runVersion();
    const bool otherCells = cellsVersion_ != bench_.cellsVersion();
    const bool otherSteps = stepsShown_ != simulation.stepsDone();
    const bool otherRows = boxes_.rowsChanged() || otherRun;
    if (otherRows) colors_.readEntities(simulation.world());
    const bool ofMotion = view_.colorBy != ColorBy::Entity && view_.colorBy != ColorBy::Cell;
    const bool otherColors = colorBy_ != view_.colorBy || (ofMotion && otherSteps) ||
                             (view_.colorBy == ColorBy::Cell && otherCells);
    bench_.watchHits(view_.colorBy == ColorBy::SinceHit);
    if (otherRows || otherColors) {
        boxes_.setColors(colors_.update(simulation, view_.colorBy, bench_.hits()));
    }
    if (otherCells) cells_.prepare(simulation.cells());
    if (comparison_) comparison_->prepare(bench_, secondViewport(), boxes_);
    runVersion_ = bench_.runVersion();
    cellsVersion_ = bench_.cellsVersion();
    stepsShown_ = simulation.stepsDone();
    colorBy_ = view_.colorBy;
}

void WindowRun::draw(const Viewport& viewport) const {
    glDisable(GL_SCISSOR_TEST);
    const Color& ground = theme.ground;
    glClearColor(ground.r / 255.0f, ground.g / 255.0f, ground.b / 255.0f, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    setViewport(viewport);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    cells_.draw(viewport, view_.overlays);
    // Where cells are crowded, their bodies would hide how crowded.
    const double opacity = view_.overlays.heatMap ? 0.5 : 1;
    boxes_.draw(viewport, opacity);
    if (!comparison_) return;
    setViewport(secondViewport());
    comparison_->draw(secondViewport(), view_.overlays, opacity);
}

void WindowRun::setViewport(const Viewport& viewport) const {
    const ScreenRect& view = viewport.view;
    const auto pixels = [&](double points) {
        return static_cast<GLint>(std::lround(points * viewport.pixelRatio));
    };
    // OpenGL counts from below.
    glViewport(pixels(view.x), size_.pixelHeight - pixels(view.y + view.height), pixels(view.width),
               pixels(view.height));
}

void WindowRun::takeScreenshots(bool last) {
    const bool asked = last && !options_.window.screenshot.empty();
    if (!asked && !view_.screenshot) return;
    const Picture picture = readFramebuffer(size_.pixelWidth, size_.pixelHeight);
    if (asked) writePng(options_.window.screenshot, picture);
    if (!view_.screenshot) return;
    view_.screenshot = false;
    const std::string file = bench_.session().run().scene + "-" +
                             std::to_string(bench_.simulation().stepsDone()) + ".png";
    try {
        writePng(file, picture);
        bench_.say("wrote " + file);
    } catch (const Error& error) {
        bench_.say(error.what(), true);
    }
}

void WindowRun::countPicture() {
    Shown& shown = *bench_.session().statistics().shown;
    shown.width = size_.pixelWidth;
    shown.height = size_.pixelHeight;
    ++shown.pictures;
    for (std::size_t i = 0; i < showPhaseCount; ++i) shown.seconds[i] += phases_[i];
}

/// Of the picture before, which has ended with the wait for this one.
void WindowRun::recordPhases(double pictureSeconds) {
    PhaseHistory::Row row{};
    const auto steps = bench_.takePhases();
    for (std::size_t i = 0; i < phaseCount; ++i) row[i] = static_cast<float>(1e3 * steps[i]);
    for (std::size_t i = 0; i < showPhaseCount; ++i) {
        row[phaseCount + i] = static_cast<float>(1e3 * phases_[i]);
    }
    row[PhaseHistory::Error] =
        static_cast<float>(1e3 * (bench_.takeErrorSeconds() + errors_.takeSeconds()));
    row[PhaseHistory::Wait] = static_cast<float>(1e3 * waited_);
    const float known = std::accumulate(row.begin(), row.end(), 0.0f);
    row[PhaseHistory::Unaccounted] =
        std::max(static_cast<float>(1e3 * pictureSeconds) - known, 0.0f);
    if (std::exchange(shownOne_, true)) history_.add(row);
    phases_ = {};
    waited_ = 0;
}

/// "balanced, step 120, paused", a few times a second while it runs.
void WindowRun::updateTitle() {
    if (!bench_.paused() && secondsSince(titleTime_) < 0.25) return;
    titleTime_ = Clock::now();
    window_.setTitle(bench_.session().run().scene + ", step " +
                     grouped(bench_.simulation().stepsDone()) +
                     (bench_.paused() ? ", paused" : "") + " - collisionStress");
}

}  // namespace

int runWindow(const Options& options) {
    WindowRun run(options);
    return run.loop();
}

}  // namespace quadrille::app
