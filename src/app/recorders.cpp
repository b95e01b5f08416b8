#include "app/recorders.hpp"

namespace quadrille::app {

FrameRecorder::FrameRecorder(const std::string& file) : out_(file) {
    out_.stream() << "frame,time,ms,contacts,collisions,pairs_tested,rebuilt,cells,"
                     "kinetic_energy\n";
}

void FrameRecorder::record(const Simulation& simulation, const StepReport& report,
                           double milliseconds) {
    out_.stream() << report.step << ',' << exact(simulation.time()) << ',' << exact(milliseconds)
                  << ',' << report.contacts << ',' << report.collisions << ',' << report.pairsTested
                  << ',' << int(report.rebuilt) << ',' << simulation.cells().size() << ','
                  << exact(kineticEnergy(simulation.world())) << '\n';
}

ComparisonRecorder::ComparisonRecorder(const std::string& file) : out_(file) {
    out_.stream() << "frame,time,apart,wrong_bodies,missed,invented,matched,position_median,"
                     "position_p99,position_max,overlap,overlap_beside,ms,ms_beside,same_state\n";
}

void ComparisonRecorder::record(const ComparedFrame& frame) {
    const accuracy::Divergence& d = frame.divergence;
    out_.stream() << frame.frame << ',' << exact(d.time) << ',' << d.apart << ',' << d.wrongBodies
                  << ',' << d.events.missed() << ',' << d.events.invented() << ','
                  << d.events.matched << ',' << exact(d.positionError.median) << ','
                  << exact(d.positionError.p99) << ',' << exact(d.positionError.max) << ','
                  << exact(d.overlapMax[0]) << ',' << exact(d.overlapMax[1]) << ','
                  << exact(frame.milliseconds[0]) << ',' << exact(frame.milliseconds[1]) << ','
                  << int(frame.stateHash[0] == frame.stateHash[1]) << '\n';
}

EventRecorder::EventRecorder(const std::string& file) : out_(file) {
    out_.stream() << "t,i,j,axis,impulse_x,impulse_y,approach_x,approach_y\n";
}

void EventRecorder::record(const Contact& contact) {
    if (!contact.collided) return;
    out_.stream() << exact(contact.time) << ',' << contact.numberA << ',' << contact.numberB << ','
                  << int(contact.axis) << ',' << exact(contact.impulse.x()) << ','
                  << exact(contact.impulse.y()) << ',' << exact(contact.approach.x()) << ','
                  << exact(contact.approach.y()) << '\n';
}

void writeState(OutputFile& out, const World& world) {
    std::ostream& stream = out.stream();
    stream << "entity,x,y,vx,vy\n";
    world.visitBodies([&](const auto& bodies) {
        const auto& m = bodies.moving;
        const CreationRanks ranks(m.created, m.size());
        for (std::size_t place = 0; place < m.size(); ++place) {
            const std::size_t i = ranks.rowAt(place);
            stream << place << ',' << exact(m.x[i]) << ',' << exact(m.y[i]) << ',' << exact(m.vx[i])
                   << ',' << exact(m.vy[i]) << '\n';
        }
    });
    out.commit();
}

}  // namespace quadrille::app
