// An external program as a planner. The program reads the problem as a YAML scenario from standard input. It prints one
// pose "x y yaw" per line from the start to the goal. The curves of the space join the poses. A shell runs the
// parameter `command`:
//   parking_plan SCENARIO --plugin libexternal_planner.so --planner external --set command="python3 PROGRAM.py"
// A program that exceeds the time limit is killed. An invalid path is an exception that concerns this run only.

#include <ompl_improved_astar/PlannerPlugin.h>
#include <state_validity/ompl/FclFootprintChecker.h>
#include <state_validity/ompl/OmplPose.h>

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Exception.h>

#include <cerrno>
#include <csignal>
#include <memory>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ob = ompl::base;

namespace
{
    constexpr std::size_t MAX_ANSWER = 16000000;  // bytes

    /** A child process with its standard input and output. The destructor kills it and all its children. */
    class Program
    {
    public:
        explicit Program(const std::string &command)
        {
            int in[2], out[2];
            if (pipe2(in, O_CLOEXEC) != 0 || pipe2(out, O_CLOEXEC) != 0)
                throw ompl::Exception("external", "no pipes for " + command);
            child_ = fork();
            if (child_ == 0)
            {
                setpgid(0, 0);
                dup2(in[0], STDIN_FILENO);
                dup2(out[1], STDOUT_FILENO);
                execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char *>(nullptr));
                _exit(127);
            }
            setpgid(child_, child_);
            close(in[0]);
            close(out[1]);
            in_ = in[1];
            out_ = out[0];
            fcntl(in_, F_SETFL, O_NONBLOCK);
            fcntl(out_, F_SETFL, O_NONBLOCK);
        }

        ~Program()
        {
            closeInput();
            close(out_);
            if (child_ > 0)
            {
                kill(-child_, SIGKILL);
                waitpid(child_, nullptr, 0);
            }
        }

        Program(const Program &) = delete;
        Program &operator=(const Program &) = delete;

        /** Writes \e question to the process and reads its output. \return false after the time limit */
        bool ask(const std::string &question, std::string &answer, const ob::PlannerTerminationCondition &ptc)
        {
            // A program that does not read all its input must not end this process.
            struct sigaction ignore = {};
            ignore.sa_handler = SIG_IGN;
            struct sigaction before;
            sigaction(SIGPIPE, &ignore, &before);
            const bool done = exchange(question, answer, ptc);
            sigaction(SIGPIPE, &before, nullptr);
            return done;
        }

        /** Exit status of the process after it has closed its output. */
        int status()
        {
            int status = 0;
            if (waitpid(child_, &status, 0) == child_)
                child_ = -1;
            return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        }

    private:
        bool exchange(const std::string &question, std::string &answer, const ob::PlannerTerminationCondition &ptc)
        {
            std::size_t sent = 0;
            while (!ptc)
            {
                if (in_ >= 0 && sent == question.size())
                    closeInput();
                pollfd ends[2] = {{out_, POLLIN, 0}, {in_, POLLOUT, 0}};
                poll(ends, in_ >= 0 ? 2 : 1, 10);
                if (in_ >= 0 && ends[1].revents != 0)
                {
                    const ssize_t count = write(in_, question.data() + sent, question.size() - sent);
                    if (count > 0)
                        sent += static_cast<std::size_t>(count);
                    else if (count < 0 && errno != EAGAIN && errno != EINTR)
                        closeInput();
                }
                if (ends[0].revents == 0)
                    continue;
                char buffer[4096];
                const ssize_t count = read(out_, buffer, sizeof buffer);
                if (count == 0)
                    return true;
                if (count > 0)
                    answer.append(buffer, static_cast<std::size_t>(count));
                if (answer.size() > MAX_ANSWER)
                    throw ompl::Exception("external", "the output of the program is too long");
            }
            return false;
        }

        void closeInput()
        {
            if (in_ >= 0)
                close(in_);
            in_ = -1;
        }

        pid_t child_{-1};
        int in_{-1}, out_{-1};
    };

    class ExternalPlanner : public ob::Planner
    {
    public:
        explicit ExternalPlanner(const ob::SpaceInformationPtr &si) : ob::Planner(si, "external")
        {
            specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
            declareParam<std::string>("command", this, &ExternalPlanner::setCommand, &ExternalPlanner::getCommand);
        }

        void setCommand(const std::string &command)
        {
            command_ = command;
        }

        std::string getCommand() const
        {
            return command_;
        }

        ob::PlannerStatus solve(const ob::PlannerTerminationCondition &ptc) override
        {
            checkValidity();
            pis_.restart();
            const ob::State *start = pis_.nextStart();
            if (start == nullptr)
                return ob::PlannerStatus::INVALID_START;
            const ob::State *goal = pis_.nextGoal(ptc);
            if (goal == nullptr)
                return ob::PlannerStatus::INVALID_GOAL;
            if (command_.empty())
                throw ompl::Exception(getName(), "set the parameter command");

            std::string answer;
            Program program(command_);
            if (!program.ask(scenario(start, goal), answer, ptc))
                return ob::PlannerStatus::TIMEOUT;
            const int status = program.status();
            if (status != 0)
                throw ompl::Exception(getName(), "the program ended with status " + std::to_string(status));
            const auto path = read(answer);
            if (path->getStateCount() == 0)
                return ob::PlannerStatus::TIMEOUT;  // the program found no path
            ob::PlannerSolution solution(path);
            solution.setPlannerName(getName());
            const double difference = si_->distance(path->getStates().back(), goal);
            if (difference > 1e-3)
                solution.setApproximate(difference);
            pdef_->addSolutionPath(solution);
            return difference > 1e-3 ? ob::PlannerStatus::APPROXIMATE_SOLUTION : ob::PlannerStatus::EXACT_SOLUTION;
        }

    private:
        static void write(std::ostream &text, const std::string &key, const parking::Pose &pose)
        {
            text << key << ": [" << pose.x << ", " << pose.y << ", " << pose.yaw << "]\n";
        }

        /** The problem as a YAML scenario in the coordinates of the space. */
        std::string scenario(const ob::State *start, const ob::State *goal) const
        {
            const auto *checker =
                dynamic_cast<const parking::FclFootprintChecker *>(si_->getStateValidityChecker().get());
            if (checker == nullptr)
                throw ompl::Exception(getName(), "supports only problems with the footprint of a car");
            const parking::Vehicle &car = checker->footprint().vehicle();
            const parking::ObstacleSet &obstacles = checker->footprint().obstacles();
            std::ostringstream text;
            text.precision(17);
            text << "vehicle: {wheelbase: " << car.wheelbase << ", front_overhang: " << car.frontOverhang
                 << ", rear_overhang: " << car.rearOverhang << ", width: " << car.width
                 << ", max_steering_angle: " << car.maxSteeringAngle;
            for (std::size_t i = 0; i < car.outline.size(); ++i)
                text << (i == 0 ? ", outline: [[" : ", [") << car.outline[i].x() << ", " << car.outline[i].y() << "]";
            text << (car.outline.empty() ? "}\n" : "]}\n");
            write(text, "start", parking::poseOf(start));
            write(text, "goal", parking::poseOf(goal));
            text << "polygons:";
            std::vector<parking::Polygon> polygons = obstacles.polygons();
            for (const parking::Box &box : obstacles.rectangles())
                polygons.push_back({box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}});
            for (const parking::Polygon &polygon : polygons)
            {
                text << "\n  - [";
                for (std::size_t i = 0; i < polygon.size(); ++i)
                {
                    const parking::Pose corner =
                        parking::compose(obstacles.frame(), {polygon[i].x(), polygon[i].y(), 0.0});
                    text << (i > 0 ? ", [" : "[") << corner.x << ", " << corner.y << "]";
                }
                text << "]";
            }
            text << (polygons.empty() ? " []\n" : "\n");
            return text.str();
        }

        std::shared_ptr<ompl::geometric::PathGeometric> read(const std::string &answer) const
        {
            auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
            std::istringstream lines(answer);
            std::size_t number = 0;
            for (std::string line; std::getline(lines, line);)
            {
                ++number;
                std::istringstream fields(line);
                parking::Pose pose;
                std::string rest;
                if (line.find_first_not_of(" \t\r") == std::string::npos)
                    continue;
                if (!(fields >> pose.x >> pose.y >> pose.yaw) || fields >> rest)
                    throw ompl::Exception(getName(),
                                          "line " + std::to_string(number) +
                                              " of the program is not a pose \"x y yaw\": " + line.substr(0, 60));
                ob::ScopedState<> state(si_);
                parking::setPose(state.get(), pose);
                path->append(state.get());
            }
            return path;
        }

        std::string command_;
    };

    void addPlanners(parking::PluginPlanners &planners)
    {
        planners.add({"external", "a program that reads a scenario and prints poses",
                      [](const ob::SpaceInformationPtr &si) { return std::make_shared<ExternalPlanner>(si); }, false});
    }
}  // namespace

PARKING_PLANNER_PLUGIN(addPlanners);
