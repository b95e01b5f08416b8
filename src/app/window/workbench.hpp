#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <quadrille/quadrille.hpp>

#include "app/options.hpp"
#include "app/run_session.hpp"
#include "app/window/comparison_history.hpp"
#include "app/window/hit_times.hpp"
#include "app/window/pacer.hpp"
#include "app/window/phase_history.hpp"
#include "app/window/timeline.hpp"
#include "app/window/trails.hpp"

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
    /// What is shown: the run, or its past.
    const Simulation& simulation() const { return *shown_; }
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
    // ---- the past

    /// Whether the run's past is kept.
    bool keepsPast() const { return timeline_.has_value(); }
    bool lookingBack() const { return lookingBack_; }
    /// What is shown, and what can be, in steps since the start; with `continuous` also between
    /// two.
    double place() const;
    std::uint64_t firstPlace() const;
    std::uint64_t lastPlace() const { return session_->simulation().stepsDone(); }
    /// Shows the past, or at the end the run itself.
    void lookAt(double place);
    void stepBack();
    /// From here backwards, or forwards again.
    void playBackwards();
    bool backwards() const { return backwards_; }
    void toNewest();
    /// Whether what is shown is still on the way to the place.
    bool seeking() const { return seeking_; }
    /// The hash of what is shown.
    std::uint64_t shownHash() const;
    /// Whether the past that is shown has the bits that the run had there; nothing between two
    /// steps.
    std::optional<bool> sameAsOnTheWay() const;

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

    // ---- the comparison with another run, if there is one

    /// What the runs are called.
    std::array<std::string, 2> labels() const;
    const ComparisonHistory& comparison() const { return comparison_; }
    /// The world of the first run, or of the second.
    const World& world(std::size_t run) const;

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

    /// Where bodies were in the steps that were shown, from when it was asked for.
    void watchTrails(bool wanted);
    const Trails& trails() const { return trails_; }

    void say(std::string text, bool isError = false);
    /// The message to show, or null.
    const Message* message() const;

  private:
    void start(Run run, Options options);
    /// The same, unless the options cannot be run; then says so, and the old run goes on.
    /// Another scene has its own law, gravity and restitution.
    void restart(Options options, const std::string& success, bool otherScene);
    template <class Change>
    Options forBoth(Change&& change) const;
    /// Throws what Simulation::reconfigure throws.
    void apply(SimulationConfig config);
    void sayFallback();
    void listen();
    void step();
    void movePast(double seconds);
    void showPast();
    void recordTrails();
    /// Says that the runs of a comparison stay as they are, if there is one.
    bool refuseChange();
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
    ComparisonHistory comparison_;

    std::optional<Timeline> timeline_;
    const Simulation* shown_ = nullptr;
    bool lookingBack_ = false, backwards_ = false, seeking_ = false;
    double place_ = 0;            // while looking back
    std::uint64_t pastHash_ = 0;  // of what is shown then

    std::optional<Entity> selected_;
    bool following_ = false;
    bool watching_ = false, watchingHits_ = false, listening_ = false;
    std::vector<Contact> contacts_;
    bool watchingTrails_ = false;
    Trails trails_;
    HitTimes hits_;
    Message message_;
};

}  // namespace quadrille::app
