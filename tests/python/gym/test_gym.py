"""The Gymnasium environments: Gymnasium's own checker, equal bits of single and vector, the rules, populations."""

import copy
import pickle
import sys
from dataclasses import replace

import gymnasium
import numpy as np
import punctura as pn
import punctura.gym as pg
import pytest
from gymnasium.envs.registration import EnvSpec
from gymnasium.utils.env_checker import check_env
from gymnasium.wrappers import TimeAwareObservation
from punctura.extras import optional
from punctura.gym.trials import Trials
from punctura.live import Fault
from punctura.simulation import Hand, Plant

NAMES = [f"punctura/{name}-v0" for name in pg.TASKS]
QUIET = Hand(tremor_rms=0)


def advance(env: pg.NeedleEnv, share: float, seconds: float) -> list[tuple]:
    """Steps with one action until the trial ends."""
    rows = []
    for _ in range(round(seconds / env.task.decision)):
        rows.append(env.step(np.array([share], np.float32)))
        if rows[-1][2] or rows[-1][3]:
            break
    return rows


@pytest.mark.parametrize("name", NAMES)
def test_gymnasiums_own_checker_passes(name):
    check_env(gymnasium.make(name, render_mode="rgb_array").unwrapped)


@pytest.mark.parametrize("threads", [1, 3])
def test_trial_i_of_a_vector_is_the_single_environment_with_seed_plus_i_bit_for_bit(threads):
    task = replace(pg.TASKS["StopAfterPop"], time_limit=1.2)
    many = pg.NeedleVectorEnv(task, 4, threads=threads)
    many.reset(seed=7)
    single = pg.NeedleEnv(task)
    singles = {i: [single.reset(seed=7 + i)[0]] for i in (0, 3)}
    for i, rows in singles.items():
        single.reset(seed=7 + i)
        rows[:] = [row[0] for row in advance(single, 1.0, 2)]
    for k in range(60):
        seen, *_ = many.step(np.ones((4, 1), np.float32))
        for i, rows in singles.items():
            if k < len(rows):
                assert (seen[i] == rows[k]).all()


def test_a_trial_of_a_vector_that_has_ended_begins_anew_in_the_next_step():
    env = gymnasium.make_vec("punctura/StopAfterPop-v0", num_envs=2).unwrapped
    assert isinstance(env, pg.NeedleVectorEnv)
    env.reset(seed=[1, 2])
    for _ in range(200):
        seen, reward, ended, _, info = env.step(np.array([[1], [0]], np.float32))
        way = seen[0, 3]
        if ended[0]:
            break
    assert list(ended) == [True, False] and list(reward) == [-1, 0]
    assert list(info["pierced"]) == [True, False] and not info["fault"].any()
    seen, reward, ended, late, info = env.step(np.ones((2, 1), np.float32))
    assert not seen[0].any() and seen[1].any()
    assert not (reward.any() or ended.any() or late.any() or info["pierced"].any())
    seen, *_ = env.step(np.ones((2, 1), np.float32))
    assert abs(seen[0, 3]) < 1 < 5 < way  # mm: it has only just begun


MASK = np.array([True, False, False])


def test_a_mask_resets_the_trials_that_it_names_and_the_others_go_on():
    ours = pg.NeedleVectorEnv("StopAfterPop", 3)
    theirs = gymnasium.make_vec("punctura/StopAfterPop-v0", num_envs=3, vectorization_mode="sync")
    action = np.full((3, 1), 0.5, np.float32)
    with pytest.raises(RuntimeError, match="have not begun"):
        ours.reset(options={"reset_mask": MASK})
    for env in (ours, theirs):
        env.reset(seed=3)
        for _ in range(20):
            env.step(action)
    (seen, _), (also, _) = (env.reset(seed=[9, None, None], options={"reset_mask": MASK}) for env in (ours, theirs))
    assert not seen[0].any() and seen[1:, 3].all()
    np.testing.assert_array_equal(seen, also)
    for _ in range(20):
        np.testing.assert_array_equal(ours.step(action)[0], theirs.step(action)[0])
    for wrong, error in (([True, False, False], TypeError), (MASK[:2], ValueError), (~MASK & MASK, ValueError)):
        with pytest.raises(error, match="reset_mask"):
            ours.reset(options={"reset_mask": wrong})


def test_with_same_step_a_trial_begins_anew_at_once_as_in_gymnasiums_own_vector():
    mode = gymnasium.vector.AutoresetMode.SAME_STEP
    ours = gymnasium.make_vec("punctura/StopAfterPop-v0", num_envs=3, autoreset_mode="SameStep")
    theirs = gymnasium.make_vec(
        "punctura/StopAfterPop-v0", num_envs=3, vectorization_mode="sync", vector_kwargs={"autoreset_mode": mode}
    )
    assert ours.metadata["autoreset_mode"] == mode
    ends = 0
    action = np.array([[1], [0.7], [0]], np.float32)
    for env in (ours, theirs):
        env.reset(seed=1)
    for _ in range(120):
        (seen, *rest, info), (also_seen, *also_rest, also) = ours.step(action), theirs.step(action)
        np.testing.assert_array_equal(seen, also_seen)
        np.testing.assert_equal(rest, also_rest)
        assert info.keys() >= also.keys()
        for word in also:
            np.testing.assert_equal(*(list(each[word]) if word == "final_obs" else each[word] for each in (info, also)))
        ends += rest[1].sum()
    assert ends >= 3


def test_without_autoreset_a_trial_that_has_ended_waits_for_its_reset():
    env = pg.NeedleVectorEnv("StopAfterPop", 3, autoreset_mode="Disabled")
    env.reset(seed=1)
    action = np.array([[1], [0], [0]], np.float32)
    while not env.step(action)[2].any():
        pass
    with pytest.raises(RuntimeError, match="trial 0 has ended: reset it"):
        env.step(action)
    env.reset(options={"reset_mask": MASK})
    assert env.step(action)[0][:, 3].all()


def test_the_picture_shows_the_needle_at_its_depth_and_the_force_beside_it():
    env = gymnasium.make("punctura/StopAfterPop-v0", render_mode="rgb_array")
    env.reset(seed=2)
    air = env.render()
    rows = []
    for _ in range(6):
        for _ in range(10):
            env.step(np.float32([0.4]))
        changed = (env.render() != air).any(2)
        needle, curve = changed[:, :240].any(1), changed[:, 240:].any(1)
        rows.append((np.flatnonzero(needle).max(), np.flatnonzero(curve).max()))
    assert all(abs(tip - force) <= 2 for tip, force in rows)
    deeper = np.diff([tip for tip, _ in rows])
    assert (deeper > 5).all()  # 1.6 mm each, and a pixel is less than 0.2 mm
    several = gymnasium.make_vec("punctura/Venipuncture-v0", num_envs=2, render_mode="rgb_array")
    several.reset(seed=2)
    assert [image.shape for image in several.render()] == [(240, 360, 3)] * 2
    assert pg.NeedleVectorEnv("StopAfterPop", 1).render() is None


def test_a_hand_that_stops_after_the_pop_succeeds_and_one_that_goes_on_fails():
    env = pg.NeedleEnv("StopAfterPop", population=pg.Population(pn.load_scene("k06-fig10")), hand=QUIET)
    env.reset(seed=3)
    highest, reward = 0.0, 0.0
    for _ in range(500):
        seen, *_ = env.step(np.array([0.5], np.float32))
        highest = max(highest, seen[2])
        if seen[1] < highest - 0.15:  # the force has fallen: the pop
            rows = advance(env, 0.0, 2)
            reward, info = rows[-1][1], rows[-1][4]
            break
    assert info == {"success": True, "pierced": False, "fault": 0}
    assert 0.5 < reward < 1
    with pytest.raises(RuntimeError, match="call reset"):
        env.step(np.array([0], np.float32))
    env.reset(seed=3)
    assert advance(env, 0.5, 10)[-1][4] == {"success": False, "pierced": True, "fault": 0}


def test_the_observation_is_what_the_device_measures_and_nothing_that_a_hand_cannot_feel():
    env = pg.NeedleEnv("StopAfterPop", hand=QUIET)
    assert env.reset(seed=1)[0].tolist() == [0] * len(pg.OBSERVATION)
    rows = np.array([row[0] for row in advance(env, 0.5, 1.0)])
    force, lowest, highest, depth, speed = rows.T
    assert (lowest <= force).all() and (force <= highest).all()
    assert np.allclose(np.diff(depth), speed[1:] * env.task.decision, atol=1e-4)
    step = Plant().encoder_step * 1e3
    assert depth[-1] == pytest.approx(0.5 * 20 * 1.0, abs=4 * step + 2)  # the hand gives way
    hidden = pg.NeedleEnv("StopAfterPop", hand=QUIET)  # another tissue, not touched yet
    hidden.reset(seed=1)
    assert (np.array([row[0] for row in advance(hidden, 0.5, 0.1)]) == rows[:5]).all()


def test_a_fault_ends_the_trial_and_is_in_the_result_of_its_own_trial_only():
    task = replace(pg.TASKS["StopAfterPop"], fastest=1000.0)
    env = pg.NeedleVectorEnv(task, 2, hand=Hand(stiffness=1e6, mass=0.01, tremor_rms=0), threads=2)
    env.reset(seed=1)
    for _ in range(5):
        _, reward, ended, _, info = env.step(np.array([[-1], [0]], np.float32))
        if ended.any():
            break
    assert Fault(int(info["fault"][0])) == Fault.position_jump and info["fault"][1] == 0
    assert list(ended) == [True, False] and reward[0] == -1


@pytest.mark.parametrize("again", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
def test_a_copied_environment_goes_on_with_the_same_bits(again):
    single = gymnasium.make("punctura/Venipuncture-v0")
    several = gymnasium.make_vec("punctura/Venipuncture-v0", num_envs=5)
    for env, action in ((single, np.float32([0.5])), (several, np.full((5, 1), 0.5, np.float32))):
        env.reset(seed=1)
        for _ in range(30):
            env.step(action)
        other = again(env)
        for _ in range(80):  # far enough that the trials of the vector begin anew
            (seen, *rest), (also_seen, *also_rest) = env.step(action), other.step(action)
            np.testing.assert_array_equal(seen, also_seen)
            np.testing.assert_equal(rest, also_rest)
            if env is single and (rest[1] or rest[2]):
                break


def late_after(env: gymnasium.Env) -> int:
    """The steps until a hand that does nothing is late."""
    env.reset(seed=1)
    return next(k for k in range(1, 2000) if env.step(np.float32([0]))[3])


@pytest.mark.parametrize(("name", "steps"), list(zip(NAMES, (1000, 1500, 1000), strict=True)))
def test_the_spec_says_after_how_many_steps_a_trial_is_late_and_makes_the_same_environment(name, steps):
    env = gymnasium.make(name)
    assert env.spec.max_episode_steps == late_after(env) == steps
    again = gymnasium.make(EnvSpec.from_json(env.spec.to_json()))
    assert again.spec.max_episode_steps == late_after(again) == steps
    assert TimeAwareObservation(env).observation_space.high[-1] == steps
    several = gymnasium.make_vec(name, num_envs=2)
    assert gymnasium.make_vec(several.spec).spec.max_episode_steps == several.spec.max_episode_steps == steps
    theirs = gymnasium.make_vec(name, num_envs=2, vectorization_mode="sync")
    assert theirs.envs[0].spec.max_episode_steps == steps


def test_a_limit_of_ones_own_is_that_of_the_task_or_of_the_caller_whichever_is_first():
    slow = replace(pg.TASKS["StopAfterPop"], decision=0.5)
    own = gymnasium.make("punctura/StopAfterPop-v0", task=slow)
    assert own.spec.max_episode_steps == late_after(own) == 40
    longer = gymnasium.make("punctura/StopAfterPop-v0", task=replace(slow, time_limit=600.0))
    assert longer.spec.max_episode_steps == late_after(longer) == 1200
    endless = gymnasium.make("punctura/StopAfterPop-v0", task=replace(slow, time_limit=np.inf))
    assert endless.spec.max_episode_steps is None
    for given, steps in ((7, 7), (50, 40), (-1, 40)):
        several = gymnasium.make_vec("punctura/StopAfterPop-v0", 2, task=slow, max_episode_steps=given)
        assert several.spec.max_episode_steps == steps
        several.reset(seed=1)
        late = [several.step(np.zeros((2, 1), np.float32))[3].tolist() for _ in range(steps)]
        assert late == [[False, False]] * (steps - 1) + [[True, True]]
    for wrong, error in ((0, ValueError), (-2, ValueError), (1.5, TypeError), (True, TypeError)):
        with pytest.raises(error, match="max_episode_steps is"):
            pg.NeedleVectorEnv("StopAfterPop", 2, max_episode_steps=wrong)


def test_a_population_draws_within_its_ranges_and_repeats_with_the_seed():
    scene = pn.load_scene("venipuncture")
    people = pg.Population(
        scene,
        [
            pg.Vary(["membrane[0].stiffness"], 0.5, 2),
            pg.Vary({"membrane[1].point[1]": 1, "membrane[2].point[1]": 2}, -1e-3, 1e-3, "shift"),
            pg.Vary(["needle.tip_angle"], 0.2, 0.3, "set"),
        ],
    )
    drawn = [people.scene_of(seed) for seed in range(30)]
    assert people.scene_of(4) == drawn[4] != drawn[5]
    for one in drawn:
        assert 450 <= one.membranes[0].membrane.stiffness <= 1800
        near, far = (one.membranes[i].point[1] - scene.membranes[i].point[1] for i in (1, 2))
        assert abs(near) <= 1e-3 and far == pytest.approx(2 * near)
        assert 0.2 <= one.needle.tip_angle <= 0.3
    assert len({one.membranes[0].membrane.stiffness for one in drawn}) == 30
    for wrong, match in [
        (pg.Vary(["membrane[9].stiffness"], 1, 2), "is not a number of scene"),
        (pg.Vary(["membrane[0].stiffness"], 2, 1), "low must be at most high"),
        (pg.Vary(["membrane[0].stiffness"], 1, 2, "times"), "how must be"),
        (pg.Vary("membrane[0].stiffness", 1, 2), "list of paths"),
        (pg.Vary({"membrane[0].stiffness": 1}, 1, 2), "weights are for"),
        (pg.Vary(["membrane[0].stiffness"], -1, 1), "must be greater than 0"),
    ]:
        with pytest.raises(ValueError, match=match):
            pg.Population(scene, [wrong])


@pytest.mark.parametrize("name", list(pg.TASKS))
def test_the_populations_of_the_tasks_have_a_space_to_stop_in(name):
    task = pg.TASKS[name]
    trials = Trials(task, 1, None, None, None, 1)
    for seed in range(20):
        scene = trials.population.scene_of(seed)
        begin, end = task.space(scene)
        if task.next_wall is not None:
            wall, after = (np.array(scene.membranes[i].point) for i in (task.wall, task.next_wall))
            end = (wall - after)[1] / -task.axis[1]
        assert end - begin > 1e-3


def test_wrong_use_is_refused_with_a_sentence():
    with pytest.raises(ValueError, match="there is no task 'Vein'; the tasks are Venipuncture"):
        pg.NeedleEnv("Vein")
    with pytest.raises(ValueError, match="too few for this task"):
        pg.NeedleEnv("Venipuncture", population=pg.Population(pn.load_scene("k06-fig10")))
    env = pg.NeedleVectorEnv("StopAfterPop", 2)
    with pytest.raises(RuntimeError, match="call reset"):
        env.step(np.zeros((2, 1), np.float32))
    with pytest.raises(ValueError, match="one number for each of the 2"):
        env.reset(seed=[1, 2, 3])
    env.reset(seed=1)
    with pytest.raises(ValueError, match=r"the actions have the shape \(3, 1\); they need \(2, 1\)"):
        env.step(np.zeros((3, 1), np.float32))
    with pytest.raises(ValueError, match="num_envs is 0: there must be at least 1"):
        pg.NeedleVectorEnv("StopAfterPop", 0)
    with pytest.raises(TypeError, match=r"3, not a punctura\.gym\.Population"):
        pg.NeedleEnv("StopAfterPop", population=3)
    env.reset(seed=np.int64(5))
    with pytest.raises(ValueError, match="action 1 is nan: an action must be a finite number"):
        env.step(np.array([[0], [np.nan]], np.float32))
    for wrong in ("x", ["a", "b"], None, {}):
        with pytest.raises(TypeError, match="the actions must be numbers"):
            env.step(wrong)
    for wrong in (2.5, "3", True):
        with pytest.raises(TypeError, match="it must be a whole number"):
            pg.NeedleVectorEnv("StopAfterPop", wrong)
    for environment in (pg.NeedleEnv, pg.NeedleVectorEnv):
        with pytest.raises(ValueError, match="render_mode is 'human'; it can be 'rgb_array'"):
            environment("StopAfterPop", render_mode="human")


@pytest.mark.parametrize(
    ("vary", "reported"),
    [
        (3, "vary must be a list"),
        ([("a", 0, 1)], "vary must be a list of punctura.gym.Vary"),
        ([pg.Vary(3, 0, 1)], "paths must be a list of paths or a mapping"),
        ([pg.Vary(["coupling.damping"], "0", 1)], "low must be a number, not '0'"),
        ([pg.Vary(["coupling.damping"], 0, None)], "high must be a number, not None"),
        ([pg.Vary({"coupling.damping": "1"}, 0, 1, "shift")], "the weight of 'coupling.damping' must be a number"),
    ],
)
def test_a_population_names_an_argument_of_another_type(vary, reported):
    with pytest.raises(TypeError, match=reported):
        pg.Population(pn.load_scene("k06-fig12"), vary)
    with pytest.raises(TypeError, match=r"scene is 3, not a punctura\.Scene"):
        pg.Population(3)


def test_the_message_without_gymnasium_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    with pytest.raises(ModuleNotFoundError, match=r"needs the package gymnasium, of the extra 'gym'\. "):
        optional("gymnasium", "gym", "punctura.gym")
