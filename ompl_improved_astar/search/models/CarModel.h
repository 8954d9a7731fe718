#pragma once

#include "ompl_improved_astar/search/MotionModel.h"
#include "ompl_improved_astar/search/models/FreeCurves.h"

#include <array>
#include <memory>
#include <vector>

namespace parking::search
{
    /** \brief Motion model of a car: arcs at the turning radius and straight lines, forwards and in reverse.

        Poses are exact; cells of position and heading only decide which are kept. Cells and steps halve from level to
        level. The first expansion of a node also tries motions up to just short of contact: the driver's manoeuvre in a
        slot, back to the limit, then full lock the other way.

        Reeds-Shepp (or Dubins) curves join nodes; all words are tried in order of cost until one is free. */
    class CarModel final : public MotionModel
    {
    public:
        void begin(const SearchContext &context) override;
        ModelTraits traits() const override;
        std::string heuristic() const override
        {
            return "curves";
        }
        std::uint64_t cell(const Pose &pose, std::size_t level) const override;
        double mobility(const Pose &root) override;
        double mobilitySlack() const override
        {
            return 0.5 * maxMotion_;
        }
        void expand(Side side, NodeIndex index, const Node &node, std::size_t level, bool isFirst,
                    std::vector<Successor> &successors) override;
        bool join(const Node &fromStart, const Node &fromGoal, Side sweptFrom, double bound,
                  const Offer &offer) override;
        void moveTowards(Side side, const Pose &from, const Pose &to, std::vector<Successor> &motions) override;
        double distance(const Pose &from, const Pose &to) const override
        {
            return curves_.distance(from, to);
        }
        const ReedsShepp *curves() const override
        {
            return &curves_;
        }
        std::size_t bytes() const override
        {
            // An array that grows is there twice, once of double the size.
            return 3 * (reaches_[0].size() + reaches_[1].size()) * sizeof(Reach);
        }

        static constexpr std::size_t LEVELS =
            7;  ///< number of resolutions, each with half the step of the previous one

    private:
        /** Free metres of a motion, and metres at its beginning that keep the preferred clearance, rounded down. */
        struct Reach
        {
            float free, clear;
        };

        void collectMotions(Side side, const Node &node);
        void measureMotions(const Pose &from);
        double clearLength(const Pose &from, const Arc &motion, double &clear);

        const SearchContext *context_{nullptr};
        ReedsShepp curves_{1.0};
        std::unique_ptr<FreeCurves> freeCurves_;
        double maxMotion_{0.0}, minMotion_{0.0};
        std::array<double, LEVELS> steps_{}, inverseCell_{}, headingScale_{};
        std::array<std::vector<Reach>, 2> reaches_;  // of the motions of each expanded node, by side
        std::vector<Arc> motions_;                   // of the node that is expanded
        std::vector<double> free_, clear_;           // lengths of these
        std::vector<PathPiece> pieces_;
    };
}  // namespace parking::search
