"""What of the flight component has a bound of its own: functions of the image, what they leave out, and what was measured beside."""
import collections
import dataclasses
import re


@dataclasses.dataclass
class Stage:
    """`left_out`: what counts as nothing within it. `together`: what is called so often in all, wherever it is called. `measured`: where the
    results of other programs have its worst, each a file and keys; the largest of them counts."""
    title: str
    function: str
    left_out: tuple = ()
    measured: tuple = ()
    together: tuple = ()


COMMANDS = ((r'lasso::CommandDispatcher::accept\(', 10),)  # kMaxCommandsPerFrame + kMaxUrgentPerFrame: all of a frame may come in one slot
# The rows of the slot table, each of which is due once.
TASKS = ((r'lasso::AcquisitionTask::poll\(', 1), (r'lasso::ImageService::run_slot\(', 1))
BOUNDARY_TASK = r'lasso::Component::pass_boundary\('
RIG = r'lasso::bare::Flight::let_world_move\('  # the board's clock stands still there
BOUNDARY = (('pil', 'float', 'instructions', 'boundary', 'worst'),)
POLL = (('pil', 'float', 'instructions', 'largest_poll', 'worst'),)
SEARCH_STEP, SEARCH_SLICE = (('count-search', 'float', '*', 'step'),), (('count-search', 'float', '*', 'slice'),)
TRACKED = (('pil', 'float', 'instructions', 'estimate', 'worst'), ('count-estimate', 'instructions', '*', 'max'))
ESTIMATE = (*TRACKED, *SEARCH_SLICE)

SLOTS = [
    Stage('the slot with the boundary', r'lasso::bare::Flight::tick\(', (RIG,), BOUNDARY, (*COMMANDS, *TASKS, (BOUNDARY_TASK, 1))),
    Stage('each of the other 19 slots', r'lasso::bare::Flight::tick\(', (RIG, BOUNDARY_TASK), POLL, (*COMMANDS, *TASKS)),
    Stage('- commands of the ground, taken from the line', r'lasso::LinkPump::receive\(', together=COMMANDS),
    Stage('- one command carried out', r'lasso::CommandDispatcher::accept\('),
    Stage("- the acquisition of a slot's samples", r'lasso::AcquisitionTask::poll\('),
    Stage('- scrub and images', r'lasso::ImageService::run_slot\('),
    Stage('- the boundary: publish', r'lasso::Component::publish_estimate\('),
    Stage('- the boundary: commands that waited', r'lasso::CommandDispatcher::answer_waiting\(', together=COMMANDS),
    Stage('- the boundary: settings and images', r'lasso::Component::update_settings\('),
    Stage('- the boundary: hand over, plan and start a scan', r'lasso::Component::(hand_over_scan|schedule_scans)\('),
    Stage('- the boundary: report', r'lasso::Component::publish_states\('),
]
ESTIMATION = [
    Stage('the estimation of a frame, in any mode', r'lasso::Component::run_estimation\(', (), ESTIMATE),
    Stage('a scan of the whole target in a track', r'lasso::track_scan\(', (), TRACKED),
    Stage('- rays and points of the scan', r'lasso::prepare_rays\('),
    Stage('- one pass of the registration', r'lasso::take_pass\(.*Descent&'),
    Stage('- one look of it', r'register_from\('),
    Stage('- coarse alignment', r'lasso::align_coarsely\('),
    Stage('- the weak axis', r'lasso::minimise_weak_axis\('),
    Stage('- one fit of the outline', r'lasso::fit_outline\('),
    Stage('- one search for labels', r'lasso::find_labels\('),
    Stage('- the update by the labels', r'lasso::apply_labels\('),
    Stage('- the agreement of the rays', r'lasso::agreement_of_rays\('),
    Stage('- an update of the filter', r'lasso::update_filter\('),
    Stage('a scan of a part', r'lasso::track_part\('),
    Stage('a scan for a bearing', r'lasso::bearing_scan\('),
    Stage('aimed rays of the scan after the next', r'lasso::aim_next\('),
    Stage('a slice of a search', r'lasso::PoseSearch::advance\(', (), SEARCH_SLICE),
    Stage('- one step of it', r'lasso::PoseSearch::step\(', (), SEARCH_STEP),
]

SHOWN = "the acquisition of a slot's samples", 'a scan of the whole target in a track'  # function by function


def find(image, pattern):
    """Address of the first function that matches; None where there is none, as it is inlined."""
    found = (at for at, function in image.functions.items() if re.search(pattern, function.title.replace('(anonymous namespace)', '{anonymous}')))
    return next(found, None)


def worst_measured(results, stage):
    """None where nothing was measured."""
    return max((worst for worst in (worst_of(results, keys) for keys in stage.measured) if worst is not None), default=None)


def unmeasured(results, stage):
    """The programs whose results have no worst of the stage."""
    return {keys[0] for keys in stage.measured if worst_of(results, keys) is None}


def worst_of(results, keys):
    """The largest value that the keys lead to; * is any key."""
    if not keys:
        return results if isinstance(results, (int, float)) else None
    if not isinstance(results, dict):
        return None
    places = results.values() if keys[0] == '*' else [results[keys[0]]] if keys[0] in results else []
    values = [value for value in (worst_of(place, keys[1:]) for place in places) if value is not None]
    return max(values, default=None)


def shares(costs, first):
    """Of each function on the dearest way from `first`: how often it is called, and its own instructions in all."""
    times, own, order = collections.Counter({(first, None): 1}), {}, []
    visit(costs, (first, None), set(), order)
    for key in reversed(order):
        cost = costs.known[key]
        own[key] = cost.own * times[key]
        for called, count in cost.calls.items():
            times[called] += count * times[key]
    return [(key, times[key], own[key]) for key in sorted(own, key=own.get, reverse=True)]


def visit(costs, key, seen, order):
    """Callees before their callers."""
    if key in seen or key not in costs.known:
        return
    seen.add(key)
    for called in costs.known[key].calls:
        visit(costs, called, seen, order)
    order.append(key)
