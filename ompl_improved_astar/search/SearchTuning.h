#pragma once

#include <cstddef>
#include <cstdint>

namespace parking::search
{
    /** \brief A disc by whose way a detour leads. */
    struct DetourDisc
    {
        double wider;  ///< than the largest disc within the car by so much, in turning radii,
        double lanes;  ///< but at least so many times as wide as the lane that the car covers at full lock
        double dear;   ///< a metre where it does not fit, but the inscribed disc does, counts as so many
    };

    /** \brief The constants that the search was tuned with, none of which changes what is found free.

        Lengths are in turning radii unless said otherwise, so that they hold for cars of any size. Unless another
        origin is given the values were chosen by hand on the 62 problems of docs/planner-figures.md (TPCAP, bundled,
        maps), for the time to the first solution and its length. */
    struct SearchTuning
    {
        /** \name Motions of the car
            @{ */
        double reach{4.0 / 3.0};         ///< of the longest motion that is tried
        double coarsestStep{2.0 / 3.0};  ///< of the motions on the coarsest level; each level halves it
        double shortestMotion{0.004};    ///< shorter ones lead nowhere
        double cell{0.1};                ///< side of a cell for steps of a metre, where xy_resolution does not say
        /** @} */

        /** \name Frontiers and levels (multi-resolution A*)
            @{ */
        double turnsRatio{8.0};            ///< each finer level gets so many times fewer turns than the one before
        std::uint64_t otherSidePeriod{6};  ///< one expansion in so many goes to the less confined side
        double worthKeeping{0.3};          ///< of a level's step: a node cheaper by that is kept beside another
        double farCurve{12.0};             ///< curves between poses farther apart than this
        std::size_t mostFarCurves{2};  ///< are tried only so many, the cheapest: what blocks these blocks the others
        double confined{0.15};  ///< curves from a node that can move less than this part of their length are not tried
        std::uint64_t patience{3000};  ///< expansions without progress after which a hopeless search ends
        double leastProgress{1e-3};    ///< metres: nearer by less is no progress
        double nearEnough{1.0 / 3.0};  ///< no more than so much farther from an unreachable goal than the inscribed
                                       ///< disc gets: as a rule the car comes no nearer,
        std::uint64_t patienceWhenNear{400};  ///< and so many such expansions end the search for the nearest place
                                              ///< (chosen on queries of seeds otherT1 and invT1)
        /** @} */

        /** \name Way round the obstacles
            @{ */
        double heuristicCell{1.0 / 6.0};     ///< side of a cell of the disc's way,
        double cellOfBody{0.35};             ///< but at least so many times the largest disc within the car,
        double cellOfLongWays{1.0 / 120.0};  ///< and on long ways so many times the straight distance,
        double coarsestCell{2.5};            ///< up to so many times what it would be else (see docs/planner.md),
        double cellOfLongest{1.0 / 1000.0};  ///< unless it is less than so many times that distance
        std::uint64_t mostCells{4000000};    ///< looked at: a world without walls must not fill the memory
        /** @} */

        /** \name Looking ahead along the disc's way

            Chosen by hand on random queries with the tuning seeds that docs/planner-figures.md names, and on the 62
            problems.
            @{ */
        double lookahead{3.0};         ///< to the place on the way that is made for,
        double lookaheadHeading{1.5};  ///< with the heading that the way has from so far before it to so far behind it,
        double mostLookahead{1.3};     ///< by a curve no longer than this times the straight line
        /** @} */

        /** \name Spreading out, until there is a solution; what waits then goes on waiting

            Chosen by hand on random queries with the tuning seeds that docs/planner-figures.md names, and on the 62
            problems.
            @{ */
        double waitPerExpansion{0.5};   ///< added to the cost of an open node for each expansion that there was in its
        double crowdedPlace{2.0};       ///< place, a square with this side,
        unsigned int crowdSectors{8};   ///< with a heading in the same one of so many parts of a turn,
        std::uint32_t mostCrowded{20};  ///< but for no more expansions than so many;
        double longerWait{4.0};         ///< when its turn comes and that is more by so much now, it goes on waiting
        /** @} */

        /** \name Detours, when the search is stuck

            Chosen by hand on random queries with the tuning seeds that docs/planner-figures.md names.
            @{ */
        std::uint64_t leastExpansions{60};    ///< before a search is called stuck,
        std::uint64_t stalledExpansions{20};  ///< and so many of the more confined side since it came nearer
        double nearer{0.25};                  ///< by this much
        DetourDisc detours[3]{{0.45, 0.67, 10.0},
                              {0.3, 1.0, 60.0},
                              {0.17, 0.43, 600.0}};  ///< one after the other: the first two keep to where a car can
                                                     ///< turn, the first unless that is far, the last to where it can
                                                     ///< drive
        std::uint64_t nextDetour{150};               ///< expansions before there is the next
        std::uint64_t extraTurns{4};                 ///< of a queue that comes nearer than it ever was
        bool greedyDetours{true};  ///< do their queues go by what lies ahead alone? With the cost so far they flood
                                   ///< what is cheap before they drive where there is less room than preferred
        double noWay{1.2};         ///< factor on the estimate of a node from which a disc's search knows none
        std::uint64_t mostDetourCells{400000};  ///< that a disc looks at
        std::uint64_t explorationPeriod{3};     ///< with detours, one expansion in so many explores:
        double exploredPlace{1.4};              ///< it is where there were the fewest, by squares with this side
        unsigned int exploredSectors{16};       ///< and so many sectors of headings
        /** @} */

        /** \name Proving that there is no way, when the search stays stuck

            Chosen by hand on random queries with the tuning seeds that docs/planner-figures.md names. The first try has
            equal, coarse cells, which soon get to the end of large yards; the second one cuts them where it matters, to
            close gaps that are only a little too narrow.
            @{ */
        std::uint64_t enclosureAfter{400};      ///< expansions with detours before the proof begins
        std::uint64_t expansionsPerColumn{10};  ///< an expansion is worth a column of cells at each end, and one
                                                ///< more for each so many that came before it
        std::size_t mostColumns{500000};        ///< at each end,
        double memoryOfEnclosures{0.25};        ///< and no more than this share of the memory for both
        double enclosureCell{0.5};              ///< side of a cell, in radii of the largest disc within the car
        int enclosureHeadings{32};              ///< cells round the circle
        double refinedCell{4.0};                ///< side of the coarsest cells of the second try, in the same radii,
        int refinedHeadings{4};                 ///< and those round the circle:
        int refinedCoarse{3};                   ///< they are cut so often where it is doubtful whether they are free,
        int refinedFine{8};                     ///< and no more than so often where it matters
        std::uint64_t stepsPerExpansion{10};    ///< of the second try at each end,
        std::uint64_t expansionsPerStep{300};   ///< and one more for each so many expansions that came before it
        /** @} */

        /** \name Thinking again after the first solution
            @{ */
        double afterthought{0.3};              ///< share of the expansions so far that is spent on it,
        std::uint64_t leastAfterthought{8};    ///< and at least so many,
        double afterthoughtPerExcess{35.0};    ///< and so many more for a path twice as long as it looked,
        double mostExcess{1.0};                ///< in proportion up to that excess
        double weightsOfAfterthought{0.7};     ///< factor on the weights: what is cheap counts more than what is near
        double stillDear{2.0};                 ///< a path that then costs more than this times what it promised
        std::uint64_t secondAfterthought{80};  ///< is worth so many more (chosen on tuneX9 to X11, F1 to F3, G1)
        double hardlyLonger{1.03};             ///< than the bare curve: nothing to look for
        double hardlyDearer{1.1};  ///< nor with a path whose cost is hardly more than its length was expected
        std::size_t fewCusps{1};   ///< to be, with no more cusps than so many
        /** @} */

        /** \name Shortening
            @{ */
        double knotSpacing{0.5};           ///< of the first shortening
        double mostKnots{20.0};            ///< but no more than so many on long paths
        double stillLong{0.15};            ///< a path longer than it looked by this share is shortened once more
        double otherKnotSpacing{0.48};     ///< then with these knots,
        double otherKnotOffset{0.15};      ///< the first of them here
        double widestSpan{12.0};           ///< later shortenings replace parts up to this length
        double muchDearer{1.75};           ///< a path that then costs more than this times what it promised,
        double shortToShortenAgain{12.0};  ///< and is longer than this, since shorter ones are relaxed,
        std::uint64_t mostShortenings{3};  ///< is shortened so many times more (chosen with seed tuneX1, too),
        double leastSpacing{0.3};          ///< with spacings from this
        double spacings{0.3};              ///< up to this much more
        /** @} */

        /** \name Turning round elsewhere

            Chosen by hand on random queries with seeds tuneX9, tuneF1 and tuneG1, and on the 62 problems.
            @{ */
        double dearTurns{1.15};       ///< a path with cusps that costs more than this times what it promised is tried
        std::size_t turnKnots{40};    ///< it is cut into no more parts than so many,
        double turnKnotSpacing{1.0};  ///< about this long on short paths
        double turnReach{4.0};        ///< from where the car begins to turn round to where it has
        std::size_t turnSpan{3};      ///< parts that are driven the other way by one curve
        std::size_t mostTurnCurves{300};  ///< pairs of poses between which curves are swept
        /** @} */

        /** \name Moving the poses between the pieces of a path

            Chosen by hand with 0.17 s of anytime on 183 random queries of the tuning seeds that docs/planner-figures.md
            names and on the 62 problems, and for first paths on 537 such queries.
            @{ */
        double dearToRelaxOnce{1.2};    ///< a first path that costs more than this times what it promised is relaxed,
        double onlyStep{0.08};          ///< once by this step and no farther than relaxReach,
        double dearToRelax{1.5};        ///< and one above this times what it promised in several passes,
        double longestToRelax{30.0};    ///< if it is shorter than this: longer ones gain little for the time
        double relaxStep{0.2};          ///< by which poses are moved at first
        double relaxReach{1.5};         ///< of the path before and after a pose that is replaced,
        std::size_t relaxCusps{2};      ///< or up to the first cusps on both sides, or the next, so many of them,
        double longestRelaxReach{6.0};  ///< but no farther than this
        std::size_t relaxations{3};     ///< passes over a path that was found: the first within relaxReach,
                                        ///< each later one a cusp farther, up to relaxCusps,
        double relaxDecay{0.4};         ///< factor on the step from one to the next
        std::size_t relaxationsOfBest{8};    ///< passes over the best path while improving,
        double relaxDecayOfBest{0.6};        ///< with this factor,
        std::size_t relaxationsPerRound{2};  ///< and so many of them at a time
        /** @} */

        /** \name Leading what was found past obstacles that it comes too near to

            Chosen by hand on random queries with seeds tuneM2 to tuneM6 and judge20261124k, and in worlds of other
            kinds (otherJ8, otherJ9, otherT21 to otherT23).
            @{ */
        double roomToSpare{1.12};      ///< factor on the preferred clearance, which is sampled along paths
        std::size_t posesBeside{6};    ///< that are tried for each part, and as many short of a cusp
        double dearerForRoom{1.02};    ///< so much dearer may a path be that keeps it between its samples, too
        std::size_t partsForRoom{3};   ///< that are planned anew,
        double reachForRoom{4.0};      ///< from so far before each to so far behind it,
        std::size_t placesForRoom{3};  ///< or up to where the car has room: the first of so many places
        double shareForRoom{0.5};      ///< of the expansions so far are spent on all of them,
        double leastForRoom{60.0};     ///< but at least so many on each
        double mostForRoom{200.0};     ///< and no more than so many
        /** @} */

        /** \name Another way than one that passes near to obstacles

            Chosen by hand on random queries with the tuning seeds that docs/planner-figures.md names.
            @{ */
        double dearlyClose{0.4};  ///< a path of whose cost this share is for being near to obstacles is thought
                                  ///< about, be it the bare curve; and if it is for what is
        double closeToEnds{1.0};  ///< farther than this from both ends, another way is looked for: one that keeps the
        double mostForAnother{1e3};  ///< preferred clearance, by as many expansions as there were, but no more than
                                     ///< this, and one by a search that begins anew
        /** @} */

        /** \name Improving until stopped
            @{ */
        std::uint64_t expansionsPerRound{200};  ///< before the weights change
        double weightDecay{0.8};                ///< factor on the weights from round to round, down to 1
        std::uint64_t shorteningsPerRound{3};   ///< passes, each with other knots
        std::uint64_t leastRounds{50};          ///< before a search that finds nothing more may end
        double closerSamples{0.02};             ///< metres from one look at what is nearer than preferred to the next,
                                                ///< before a path takes the place of a dearer one
        /** @} */

        /** \name Beginning anew meanwhile, for as many expansions in each round

            Chosen by hand on random queries with seeds tuneX11 and tuneF3, and on the 62 problems.
            @{ */
        double firstRestart{150.0};        ///< expansions of the first of these searches,
        double longerRestarts{1.3};        ///< factor on them from search to search,
        double mostOfRestart{1e6};         ///< up to so many
        std::size_t restartsPerRound{10};  ///< no more searches than so many begin
        double memoryOfRestarts{0.25};     ///< share of the memory that one may take
        double otherMotions{0.5};          ///< motions are longer or shorter by up to this share
        double dearerToBeShortened{1.1};   ///< factor on the cost of the best path: what costs less is shortened
        /** @} */
    };

    /** \brief The cells of the table of curve lengths (see CurveHeuristic), in turning radii and in parts of a turn.

        Fixed when the project is built: all planners of a process share the table. Chosen as those of SearchTuning. */
    struct CurveTableCells
    {
        static constexpr double NEAR{1.5};                   ///< within this the cells are finer
        static constexpr double NEAR_SIDE{0.04};             ///< of a cell near the targets
        static constexpr double FAR_SIDE{0.16};              ///< and farther away
        static constexpr int NEAR_HEADINGS{180};             ///< cells round the circle, near the targets
        static constexpr int FAR_HEADINGS{60};               ///< and farther away
        static constexpr double FARTHEST{2047.0};            ///< columns and rows; what lies beyond is not tabulated
        static constexpr std::size_t SLOTS{1u << 15};        ///< lengths that are remembered
        static constexpr std::size_t FIRST_SLOTS{1u << 10};  ///< of them in use until there is more to remember
    };
}  // namespace parking::search
