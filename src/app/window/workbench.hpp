#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "app/options.hpp"
#include "app/run_session.hpp"
#include "app/window/hit_times.hpp"
#include "app/window/pacer.hpp"
#include "app/window/phase_history.hpp"

namespace quadrille::app {

/// A scene that comes with the program, and a line about it.
struct ShippedScene {
    std::string name, about;
};

/// The run that a window shows, and all that its user can do to it; knows nothing of the screen.
class Workbench {
  public:
    using Clock = std::chrono::steady_clock;

    /// A line that is shown for some seconds.
    struct Message {
        std::string text;
        bool isError = false;
        Clock::time_point until;
    };

    explicit Workbench(const Options& options);

    RunSession& session() { return *session_; }
    const RunSession& session() const { return *session_; }
    const Simulation& simulation() const { return session_->simulation(); }
    const SimulationConfig& config() const { return session_->simulation().config(); }

    // ---- time

    bool paused() const { return paused_; }
    void togglePause();
    /// One step, and pauses.
    void singleStep();
    double speed() const { return pacer_.speed(); }
    void setSpeed(double speed);
    /// To the next of the speeds that the window offers: x1/4 to x8, then as fast as it can.
    void changeSpeed(bool faster);

    /// Runs the steps that are due after `seconds` of wall time, or of a film's, which drops none
    /// however long they take; returns how many there were.
    int advance(double seconds);
    /// What the steps took since the last call, by phase in s.
    std::array<double, phaseCount> takePhases();
    /// And what --error took beside them.
    double takeErrorSeconds();

    /// Of the last step, or empty before the first.
    const StepReport& lastStep() const { return lastStep_; }

    // ---- the run

    /// From the start of the scene or snapshot, with the partitioner, law, resolver, gravity and
    /// restitution of now.
    void reset();
    /// The same with another seed, or another count of the first spawn group.
    void restartWith(std::optional<std::uint64_t> seed, std::optional<std::uint64_t> count);
    /// Goes on with another scene, a name or a file, and with the law that it names, if it names
    /// one; says so if it cannot, and keeps the old one.
    void open(const std::string& scene);
    /// So many further on in the list of shipped scenes, the first after the last.
    void openNext(int further);
    const std::vector<ShippedScene>& scenes() const { return scenes_; }
    /// What the scene says of itself; empty if it says nothing.
    const std::string& aboutScene() const { return about_; }
    /// Or else from a snapshot.
    bool startsFromScene() const { return options_->load.empty(); }
    /// Changes what a step is made with; says so if it cannot be run, and keeps the old. Where only
    /// the resolver is in the way, and was not chosen now, the sequential one takes its place.
    void reconfigure(SimulationConfig config);
    void setPartitioner(const PartitionerConfig& partitioner);
    void nextLaw();
    /// The next one that can run.
    void nextResolver();

    /// Counts the changes of the cells, and of the run as a whole.
    std::uint64_t cellsVersion() const { return cellsVersion_; }
    std::uint64_t runVersion() const { return runVersion_; }

    // ---- looking closer

    void select(std::optional<Entity> entity);
    /// The selected entity, if it lives.
    std::optional<Entity> selected() const;
    bool following() const { return following_ && selected(); }
    void toggleFollow();
    /// The contacts of the last step, from the first step after they were asked for.
    void watchContacts(bool wanted);
    const std::vector<Contact>& contacts() const { return contacts_; }
    /// When bodies were last hit, from the first step after that was asked for.
    void watchHits(bool wanted);
    const HitTimes& hits() const { return hits_; }

    void say(std::string text, bool isError = false);
    /// The message to show, or null.
    const Message* message() const;

  private:
    void start(Run run, Options options);
    /// The same, unless the options cannot be run; then says so, and the old run goes on.
    /// Another scene has its own law, gravity and restitution.
    void restart(Options options, const std::string& success, bool otherScene);
    /// Throws what Simulation::reconfigure throws.
    void apply(SimulationConfig config);
    void sayFallback();
    void listen();
    void step();
    bool done() const { return session_->allFramesDone(); }

    std::vector<ShippedScene> scenes_;
    std::string about_;
    std::unique_ptr<Options> options_;  // the session refers to them
    std::unique_ptr<RunSession> session_;
    bool filmed_;
    Pacer pacer_;
    bool paused_;
    StepReport lastStep_;
    std::array<double, phaseCount> phases_{};
    double errorSeconds_ = 0;
    std::uint64_t cellsVersion_ = 0, runVersion_ = 0;

    std::optional<Entity> selected_;
    bool following_ = false;
    bool watching_ = false, watchingHits_ = false, listening_ = false;
    std::vector<Contact> contacts_;
    HitTimes hits_;
    Message message_;
};

}  // namespace quadrille::app
