// Writes docs/results/car-slot-table.md, the number of stretches in which each car parks in each slot, or checks that
// the file is up to date.

#include "automatic_parking/SlotQuestions.h"
#include "parking_geometry/Error.h"
#include "parking_geometry/text/ReadFile.h"
#include "parking_geometry/text/Text.h"
#include "parking_geometry/text/WriteFile.h"

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace
{
    using namespace parking;

    /** One kind of slot in one standard. Metres and degrees. */
    struct Standard
    {
        const char *country;
        const char *name;
        const char *source;
        SlotKind kind;
        double length, width;
        double aisle;
        bool assumed;  ///< whether the source states no width of aisle or lane
        double angle{90.0};
    };

    constexpr double LANE = 3.5;  // default in metres

    const char *const EAR = "baubegleitende-rechtsberatung.de, helpster.de";
    const char *const GARAGES = "derbausv.de, \"Garagenverordnung im Bild\"";
    const char *const JGJ = "us.ok.com, pages on national regulations";
    const char *const GAT = "yuyouke.com, mqiang.com";
    const char *const PORTSMOUTH = "www2.portsmouthva.gov, Weblink7, document 623, page 193";
    const char *const BUCKINGHAMSHIRE = "buckinghamshire.gov.uk, \"Parking guidance for new developments\", section 8";
    const char *const MLIT = "parkengineer.com/column/691, stagew.jp; aisle: irodori-s.jp";

    const Standard STANDARDS[] = {
        {"Germany", "EAR 05", EAR, SlotKind::Perpendicular, 5.0, 2.5, 6.0, true},
        {"Germany", "Garagenverordnung", GARAGES, SlotKind::Perpendicular, 5.0, 2.3, 6.5, true},
        {"Germany", "EAR 05, beside walls", EAR, SlotKind::Parallel, 6.5, 2.3, LANE, true},
        {"Germany", "Garagenverordnung", GARAGES, SlotKind::Parallel, 6.0, 2.3, LANE, true},
        {"China", "JGJ 100-2015, small car", JGJ, SlotKind::Perpendicular, 5.3, 2.4, 5.5, false},
        {"China", "GA/T 850", GAT, SlotKind::Parallel, 6.0, 2.5, LANE, true},
        {"China", "GA/T 850", GAT, SlotKind::Angled, 6.0, 2.5, 4.5, true, 60.0},
        {"China", "GA/T 850", GAT, SlotKind::Angled, 6.0, 2.5, 4.0, true, 45.0},
        {"USA", "Portsmouth, standard", PORTSMOUTH, SlotKind::Perpendicular, 5.486, 2.743, 7.315, false},
        {"USA", "Portsmouth, compact", PORTSMOUTH, SlotKind::Perpendicular, 5.182, 2.438, 7.315, false},
        {"USA", "Portsmouth, standard", PORTSMOUTH, SlotKind::Angled, 5.486, 2.743, 5.486, false, 60.0},
        {"USA", "Portsmouth, standard", PORTSMOUTH, SlotKind::Angled, 5.486, 2.743, 4.267, false, 45.0},
        {"USA", "Portsmouth, standard", PORTSMOUTH, SlotKind::Parallel, 6.706, 2.438, 3.658, false},
        {"USA", "Portsmouth, compact", PORTSMOUTH, SlotKind::Parallel, 6.096, 2.438, 3.658, false},
        {"UK", "usual bay", "cravencountryjamboree.com, \"How big must a parking space be?\" (weak)",
         SlotKind::Perpendicular, 4.8, 2.4, 6.0, false},
        {"UK", "Buckinghamshire", BUCKINGHAMSHIRE, SlotKind::Perpendicular, 5.0, 2.8, 6.5, false},
        {"UK", "Buckinghamshire", BUCKINGHAMSHIRE, SlotKind::Parallel, 6.0, 3.0, LANE, true},
        {"Japan", "MLIT 1992, ordinary car", MLIT, SlotKind::Perpendicular, 6.0, 2.5, 5.5, false},
        {"Japan", "MLIT 1992, small car", MLIT, SlotKind::Perpendicular, 5.0, 2.3, 5.0, false},
    };

    /** Rounds to a number of decimals. */
    std::string rounded(double value, int decimals)
    {
        const double unit = std::pow(10.0, decimals);
        return formatNumber(std::round(value * unit) / unit);
    }

    std::string kindOf(const Standard &standard)
    {
        switch (standard.kind)
        {
            case SlotKind::Perpendicular:
                return "perpendicular";
            case SlotKind::Parallel:
                return "parallel";
            default:
                return formatNumber(standard.angle) + " degrees";
        }
    }

    ParkingSlot slotOf(const Standard &standard)
    {
        ParkingSlot slot;
        slot.kind = standard.kind;
        slot.length = standard.length;
        slot.width = standard.width;
        slot.angle = standard.angle * PI / 180.0;
        slot.side = SlotSide::Right;
        slot.entry = standard.kind == SlotKind::Angled ? SlotEntry::Forward : SlotEntry::Reverse;
        return slot;
    }

    std::string movesInto(const ParkingSlot &slot, const Vehicle &car, double aisle)
    {
        const ParkingPlanner planner(PlanningParameters::intoTightSlots(aisle));
        const double leastGap = planner.parameters().gaps.back();
        if (car.length() + 2.0 * leastGap > slot.length)
            return "long";
        if (car.width + 2.0 * leastGap > slot.width)
            return "wide";
        const ReverseParkingResult result = planSlotEntry(planner, car, slot);
        return result.fits() ? std::to_string(result.path.stretches().size()) : "-";
    }

    /** Header and rule of a table. */
    std::string header(const std::vector<std::string> &columns)
    {
        std::string names = "|", rule = "|";
        for (const std::string &column : columns)
        {
            names += ' ' + column + " |";
            rule += " --- |";
        }
        return names + '\n' + rule + '\n';
    }

    std::string movesTable(const std::vector<Vehicle> &cars)
    {
        std::vector<std::string> columns{"slot", "kind", "length x width", "aisle"};
        for (const Vehicle &car : cars)
            columns.push_back(car.name);
        std::string text = header(columns);
        for (const Standard &standard : STANDARDS)
        {
            text += std::string("| ") + standard.country + ", " + standard.name + " | " + kindOf(standard) + " | " +
                    formatNumber(standard.length) + " x " + formatNumber(standard.width) + " | " +
                    formatNumber(standard.aisle) + (standard.assumed ? "*" : "") + " |";
            for (const Vehicle &car : cars)
                text += ' ' + movesInto(slotOf(standard), car, standard.aisle) + " |";
            text += '\n';
        }
        return text;
    }

    /** Space for a single sweep, and stretches in two tight cases. */
    std::string needsTable(const std::vector<Vehicle> &cars)
    {
        std::string text =
            header({"car", "length x width", "R_min", "aisle for one sweep, 2.5 m slot", "parallel slot for one sweep",
                    "stretches, parallel, length + 0.5 m", "stretches, perpendicular, width + 0.3 m, aisle 4.5 m"});
        for (const Vehicle &car : cars)
        {
            ParkingSlot bay;
            bay.length = car.length() + 0.3;
            bay.width = 2.5;
            bay.side = SlotSide::Right;
            ParkingSlot kerbside = bay, tight = bay, narrow = bay;
            kerbside.kind = tight.kind = SlotKind::Parallel;
            kerbside.length = tight.length = car.length() + 0.5;
            kerbside.width = tight.width = car.width + 0.5;
            narrow.width = car.width + 0.3;
            const ReverseParking sweep(car);
            text += "| " + car.name + " | " + rounded(car.length(), 3) + " x " + rounded(car.width, 3) + " | " +
                    rounded(car.minTurningRadius(), 2) + " | " + rounded(sweep.plan(bay).neededAisleWidth, 2) + " | " +
                    rounded(sweep.plan(kerbside).neededSlotLength, 2) + " | " + movesInto(tight, car, 4.5) + " | " +
                    movesInto(narrow, car, 4.5) + " |\n";
        }
        return text;
    }

    std::string sources()
    {
        std::string text;
        for (const Standard &standard : STANDARDS)
        {
            const std::string line =
                std::string("- ") + standard.country + ", " + standard.name + ": " + standard.source + "\n";
            if (text.find(line) == std::string::npos)
                text += line;
        }
        return text;
    }

    std::string document()
    {
        std::vector<Vehicle> cars;
        for (const std::string &name : vehicleNames())
            cars.push_back(vehicleByName(name));
        return "# Cars and parking slots\n\n"
               "The number of stretches in which each car parks in each slot. Made by `car_slot_table FILE`, which\n"
               "`scripts/results` runs; see [results](../results.md).\n\n"
               "A stretch is a part between changes of direction, from the aisle into the slot: 1 is a single sweep.\n"
               "`long` and `wide`: the car is longer or wider than the slot, less 1 cm at either end. `-`: no path was "
               "found.\n"
               "Cars enter in reverse, except for angled slots. Lengths in metres.\n\n"
               "The world is that of `slotSurroundings()`: neighbours fill their slots up to the line, the kerb of a\n"
               "parallel slot is a wall, and a wall bounds the aisle. The car stops in the middle. A sweep keeps 5 cm\n"
               "round the body, several stretches 1 to 5 cm. Cars between real cars, which leave some of their slots\n"
               "free, need fewer stretches.\n\n" +
               movesTable(cars) +
               "\n"
               "\\* The source does not state the width of the aisle or lane: the number is assumed.\n\n"
               "## Requirements of a car\n\n"
               "Perpendicular slots are 0.3 m longer than the car, parallel ones 0.5 m wider. The shortest parallel\n"
               "slot is that of a car in its middle.\n\n" +
               needsTable(cars) +
               "\n## Sources\n\n"
               "Cars: see [VehicleCatalogue.cpp](../../parking_geometry/VehicleCatalogue.cpp), which names them one by "
               "one.\n"
               "Slots, most of them from pages that quote the rule and not from its own text:\n\n" +
               sources();
    }
}  // namespace

int main(int argc, char **argv)
{
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const char *const usage =
        "usage: car_slot_table FILE           write the table\n"
        "       car_slot_table --check FILE   exit 1 when FILE is not up to date\n\n"
        "Computes the number of stretches in which each known car parks in standard slots.\n\n"
        "Examples, run at the root of the project:\n"
        "  car_slot_table table.md\n"
        "  car_slot_table --check docs/results/car-slot-table.md\n";
    if (arguments.size() == 1 && arguments[0] == "--help")
    {
        std::cout << usage;
        return std::cout.flush() ? 0 : 2;
    }
    const bool check = arguments.size() == 2 && arguments[0] == "--check";
    if (!check && (arguments.size() != 1 || arguments[0].empty() || arguments[0][0] == '-'))
    {
        std::cerr << usage;
        return 2;
    }
    try
    {
        const std::string text = document();
        if (!check)
            writeFileAtomically(arguments[0], text);
        else if (readFile(arguments[1], 1 << 20) != text)
        {
            std::cerr << arguments[1] << " is not the output of this program; car_slot_table FILE writes it\n";
            return 1;
        }
        return 0;
    }
    catch (const Error &error)
    {
        std::cerr << "car_slot_table: " << error.what() << '\n';
        return 2;
    }
}
