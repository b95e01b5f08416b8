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
