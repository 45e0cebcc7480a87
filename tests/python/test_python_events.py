"""The Python package: events, a ground that moves, coordinates that are imposed."""
import os
import pickle
import subprocess

import fvi
import numpy as np
import pytest

PROGRAM = os.environ.get("FVI", "build/fvi")
BALL = fvi.Problem("9.81*x", rho=0.05, alpha=0.3, x0=1, p0=0, time=3)
WORDS = ["--potential", "9.81*x", "--rho", "0.05", "--alpha", "0.3", "--x0", "1", "--p0", "0", "--time", "3", "--steps", "6"]
FRAME = fvi.Problem("k*x1^2/2 + k*(x2-x1)^2/2", let={"k": 100}, rho=[5, 0], order=0.6, x0=0, p0=0, time=10)
OF_FRAME = ["--potential", "k*x1^2/2 + k*(x2-x1)^2/2", "--let", "k=100", "--rho", "5,0", "--order", "0.6", "--x0", "0",
            "--p0", "0", "--time", "10", "--h", "0.02", "--method", "fvi-lobatto4"]


def program(*words):
    """Its rows, and of each event the time and the name."""
    text = subprocess.run([PROGRAM, "run", *words], check=True, capture_output=True, text=True).stdout.splitlines()
    said = [line.removeprefix("# event at t = ").split(" : ", 1) for line in text if line.startswith("# event at t = ")]
    return np.array([line.split("\t") for line in text if line[0] != "#"], dtype=float), said


# ---- events ----

@pytest.mark.parametrize("events", [["x : impact:0.8", "v : mark"], ["x - 0.5 : stop"], ["x : impact:0.3", "x - v/9 : mark"],
                                    ["x + t/9 : impact:1", "p + 2 : mark"]])
def test_events_are_the_programs(events):
    s = fvi.solve(BALL, events=events, steps=6)
    rows, said = program(*WORDS, *(word for event in events for word in ("--event", event)))
    assert np.array_equal(np.column_stack([s.t, s.x, s.p, s.energy]), rows)
    mine = sorted((t, event.partition(" : ")[0]) for event, times in zip(events, s.t_events) for t in times)
    assert mine == sorted((float(t), name.removesuffix(" : at rest")) for t, name in said) and len(mine) > 0


def test_a_body_rests_and_lifts_off():
    """On a table, under the force 2 sin t: off at pi/6. As the program; and a function with a normal of its own does the same."""
    table = fvi.Problem("x", force="2*sin(t)", x0=0, p0=0, alpha=0.3, rho=0.2, time=1.5)
    s = fvi.solve(table, events="x : contact:0.5", steps=6)
    rows, _ = program("--potential", "x", "--force", "2*sin(t)", "--x0", "0", "--p0", "0", "--alpha", "0.3", "--rho", "0.2",
                      "--time", "1.5", "--steps", "6", "--event", "x : contact:0.5")
    assert np.array_equal(np.column_stack([s.t, s.x, s.p, s.energy]), rows)
    assert s.success and s.t_events[0][0] == 0 and abs(s.t_events[0][1] - np.pi / 6) < 1e-8
    assert s.status_events[0].tolist() == ["at rest", "lifts off"] and s.message.endswith("steps of fvi-adaptive")
    own = fvi.Event(lambda t, x, p: x, "contact:0.5", gradient=lambda t, x: (1.0, 0.0))
    assert np.allclose(fvi.solve(table, events=own, steps=6).x, s.x, atol=1e-12)
    assert np.allclose(s.v, s.p) and np.allclose(s.a[:3], 0, atol=1e-6)


def test_a_damper_with_the_name_of_an_event_is_refused():
    """event1.force would be the force of either. event2 is free if there is one event."""
    tables = {}
    for name in ("event1", "event2"):
        tables[name] = fvi.solve(fvi.Problem(dampers=[f"{name} = x : power:1,0.3"], time=2), events="x + 9 : mark", steps=2)
    with pytest.raises(ValueError, match="^damper.*: 'event1' is the name of an event in columns, as in event1.force"):
        tables["event1"].table("t,event1.force")
    assert list(tables["event2"].table("t,event1.force,event2.force")) == ["t", "event1.force", "event2.force"]


@pytest.mark.parametrize("how", [{}, {"error": 1e-8}])
def test_what_a_surface_does_is_known(how, tmp_path):
    """The columns of events are the program's. The message tells of a body at rest, and not of one that has lifted off."""
    table = fvi.Problem("x", force="2*sin(t)", x0=0, p0=0, alpha=0.3, rho=0.2, time=3)
    names = "t,event1.count,event1.last,event1.force"
    rows, said = program("--potential", "x", "--force", "2*sin(t)", "--x0", "0", "--p0", "0", "--alpha", "0.3", "--rho", "0.2",
                         "--time", "3", "--steps", "6", "--event", "x : contact:0.5", "--columns", names,
                         *(word for name, value in how.items() for word in (f"--{name}", str(value))))
    s = fvi.solve(table, events="x : contact:0.5", steps=6, **how)
    columns = np.column_stack(list(s.table(names).values()))  # with error they are of another run, of the same accuracy
    assert np.array_equal(columns, rows) if not how else abs(columns - rows).max() <= 1e-8  # seen: 2e-14
    assert abs(columns[:2, 3] - (1 - 2 * np.sin(columns[:2, 0]))).max() < 1e-8 and not columns[2:, 3].any()
    assert s.reduce("max(event1.force)")["max(event1.force)"] == columns[:, 3].max()
    assert [name.partition(" : ")[2] for _, name in said] == s.status_events[0].tolist()
    assert "at rest" not in s.message and pickle.loads(pickle.dumps(s)).status_events[0][1] == "lifts off"
    falls = fvi.Problem("x", x0=1, p0=0, rho=0, time=6)
    down = fvi.solve(falls, events=["x : contact:0.5", "t - 5 : mark"], steps=6, **how)
    assert "at rest at 'x' from t = 4.24" in down.message and down.success and len(down.t) == 7
    assert down.status_events[0].tolist() == [""] * (len(down.t_events[0]) - 1) + ["at rest"]
    assert down.status_events[1].tolist() == [""]
    if not how:
        for _ in range(2):
            kept = fvi.solve(falls, events=["x : contact:0.5", "t - 5 : mark"], steps=6, checkpoint=tmp_path / "run.npz")
            assert kept.message == down.message and np.array_equal(kept.status_events[0], down.status_events[0])


def test_a_ball_bounces_at_the_times_of_free_fall():
    """No damping: it falls for (2/g)^(1/2), and flies for 2 e^n (2/g)^(1/2) after each impact."""
    g, e = 9.81, 0.8
    s = fvi.solve(BALL.replace(rho=0), events="x : impact:0.8")
    first = np.sqrt(2 / g)
    exact = first * np.cumsum([1, *(2 * e ** np.arange(1, len(s.t_events[0])))])
    assert len(exact) == 6 and abs(s.t_events[0] - exact).max() < 1e-14  # seen: 1e-15
    assert abs(s.p_events[0][:, 0] - np.sqrt(2 * g) * e ** np.arange(1, 7)).max() < 1e-13  # seen: 5e-15
    assert abs(s.x_events[0]).max() < 1e-14
    t = np.array([0.1, 0.5, 1.5])
    k = np.searchsorted(exact, t)
    since = t - np.append(0, exact)[k]
    fly = np.where(k == 0, 1 - g * t**2 / 2, np.sqrt(2 * g) * e**k * since - g * since**2 / 2)
    assert abs(s(t)[:, 0] - fly).max() < 1e-13


def test_a_lagrangian_has_events():
    """The program's rows and times; forces and work are known, and what the balance loses the impacts took."""
    L, wall = "v1^2 + v2^2/2 + v1*v2*cos(x1-x2) + 2*cos(x1) + cos(x2)", "sin(x1)+sin(x2)-0.2 : impact:0.6"
    q = fvi.Problem(lagrangian=L, dampers=["elbow=x2-x1 : power:0.3,0.25"], x0=[1, 1.5], v0=[0, 0.5], time=6)
    s = fvi.solve(q, events=[wall, "v1 : mark"], steps=6)
    rows, said = program("--lagrangian", L, "--damper", "elbow=x2-x1 : power:0.3,0.25", "--x0", "1,1.5", "--v0", "0,0.5",
                         "--time", "6", "--steps", "6", "--event", wall, "--event", "v1 : mark")
    assert np.array_equal(np.column_stack([s.t, s.x, s.p]), rows[:, :5])
    assert len(s.t_events[0]) > 0 and len(said) == sum(map(len, s.t_events))
    for t, x, p in zip(s.t_events[1], s.x_events[1], s.p_events[1]):
        c = np.cos(x[0] - x[1])  # v = M^-1 p
        assert abs(np.linalg.solve([[2, c], [c, 1]], p)[0]) < 1e-9


def test_an_event_may_be_a_function():
    texts = fvi.solve(BALL, events=["x : impact:0.8", fvi.Event("v", direction=-1), "x - 2 : stop"])
    own = fvi.solve(BALL, events=[fvi.Event(lambda t, x, p: x, "impact:0.8", lambda t, x: (1, 0)),
                                  fvi.Event(lambda t, x, p: p, direction=-1), fvi.Event(lambda t, x, p: x - 2, "stop")])
    assert np.array_equal(texts.x, own.x) and len(texts.t_events[1]) > 3 and len(texts.t_events[2]) == 0
    assert all(np.array_equal(a, b) for a, b in zip(texts.t_events, own.t_events))
    two = BALL.replace(potential="9.81*x1 + x2^2/2", x0=[1, 1], p0=[0, 0])
    wall = fvi.Event(lambda t, x, p: x[0] + x[1] / 9 - t, "impact:0.5", lambda t, x: ([1, 1 / 9], -1))
    one, other = (fvi.solve(two, events=event) for event in (wall, "x1 + x2/9 - t : impact:0.5"))
    assert abs(one.x - other.x).max() < 1e-13 and one.x_events[0].shape[1] == 2 and len(one.t_events[0]) > 0
    with pytest.raises(ZeroDivisionError):
        fvi.solve(BALL, events=fvi.Event(lambda t, x, p: 1 / 0))
    with pytest.raises(TypeError, match="^events: gradient gave 1, not dz/dx and dz/dt"):
        fvi.solve(BALL, events=fvi.Event(lambda t, x, p: x, "impact:1", lambda t, x: 1))


@pytest.mark.parametrize("error", [1e-3, 1e-6, 1e-10])
def test_an_error_may_be_asked_for_with_events(error):
    """Against a run whose steps are right to rounding, with the same height of rest; the largest speed is 4.4."""
    floor, top = fvi.Event("x", "impact:0.5", rest=error), fvi.Event("v", direction=-1)
    fine = fvi.solve(BALL, events=[floor, top], step_error=1e-15)
    for events in ([floor, top], ["x : impact:0.5", top]):
        s = fvi.solve(BALL, events=events, error=error)
        assert s.estimate <= error and len(s.t) == len(fine.t) and abs(s.x - fine.x).max() <= error + 1e-13
        for mine, those in zip(s.t_events, fine.t_events):
            assert len(mine) == len(those) > 3 and abs(mine - those).max() <= error + 1e-13  # seen: 0.01 error
        assert "at rest at 'x' from t = 1." in s.message and abs(s.x_events[0]).max() < 1e-13
        assert abs(s(s.t) - s.x).max() <= error and abs(s(s.t_events[1]) - s.x_events[1]).max() <= error
        assert s.a.shape == s.x.shape and pickle.loads(pickle.dumps(s))(0.7) == s(0.7)
    grid = fvi.sweep(BALL, {"rho": [0, 0.05]}, lambda s: s.t_events[0][-1], events=["x : impact:0.5"], error=error)
    assert abs(grid[1] - fine.t_events[0][-1]) <= error + 1e-13


def test_a_motion_that_has_ended_says_where():
    s = fvi.solve(BALL, events="x - 0.5 : stop", steps=30)
    assert s.success and s.message.endswith("ended by 'x - 0.5' at t = 0.319594") and s.t[-1] < s.t_events[0][0] < s.t[-1] + 0.1
    assert abs(s(s.t_events[0])[0, 0] - 0.5) < 1e-14 and np.array_equal(s(s.t), s.x)
    with pytest.raises(ValueError, match="^t: 2 is behind the end of the motion, t = 0.319594"):
        s(2)
    rest = fvi.solve(BALL, [0.5, 2.5], events="x : impact:0.3")
    assert "at rest at 'x' from t = 0.8398" in rest.message and len(rest.t) == 1 and len(rest.t_events[0]) > 9
    again = pickle.loads(pickle.dumps(rest))
    assert np.array_equal(again.t_events[0], rest.t_events[0]) and again(0.7) == rest(0.7)


def test_with_events_an_acceleration_is_known_and_a_force_is_not():
    s = fvi.solve(BALL.replace(rho=0), events="x : impact:0.8")
    assert abs(s.a + 9.81).max() < 1e-12 and s.v.shape == s.x.shape
    with pytest.raises(fvi.Error, match="not known with events") as caught:
        s.forces
    assert caught.value.code == 23


@pytest.mark.parametrize("call, what, why", [
    (lambda: fvi.solve(BALL, events="x"), ValueError, "^events: 'x' is not 'Z : WHAT'"),
    (lambda: fvi.solve(BALL, events=3), TypeError, "^events: 3 is no text"),
    (lambda: fvi.solve(BALL, events=[3]), TypeError, "^events: 3 is no text 'Z : WHAT' and no fvi.Event"),
    (lambda: fvi.solve(BALL, events="x : impct:1"), ValueError, "did you mean impact"),
    (lambda: fvi.solve(BALL, events="x : impact:2"), fvi.Error, "^events: .*2"),
    (lambda: fvi.solve(BALL, events="v : impact:1"), ValueError, "knows a velocity|x and t alone"),
    (lambda: fvi.solve(BALL, events="y : stop"), ValueError, "^events: .*y"),
    (lambda: fvi.solve(fvi.Problem(), events="x2 : mark"), ValueError, "^events: 'x2': there is no x2; .* x alone"),
    (lambda: fvi.solve(BALL, events="x : stop", error=1e-6, method="fvi-bdf2"), fvi.Error, "no events; fvi-adaptive has"),
    (lambda: fvi.solve(BALL, events=fvi.Event("x", "impact:0.5", rest=-1)), ValueError, r"^events: rest: -1 is not in \[0"),
    (lambda: fvi.solve(BALL.replace(rho=0, time=400), events="x-0.1*sin(7*t) : impact:1", error=1e-6), fvi.Error,
     "^error: 1e-06 is out of reach: no two runs have the same events; they agree on "),
    (lambda: fvi.solve(BALL, events="x : stop", method="fvi", h=0.1), fvi.Error, "has no events; fvi-adaptive has"),
    (lambda: fvi.solve(BALL, events=fvi.Event(lambda t, x, p: x, "impact:1")), fvi.Error, "needs its gradient"),
    (lambda: fvi.solve(BALL, [2, 1], events="x : mark"), ValueError, "^t_eval: .* must increase"),
    (lambda: fvi.solve(BALL, [-1, 1], events="x : mark"), ValueError, r"^t_eval: .* must be in \[0, 3\]"),
    (lambda: fvi.solve(BALL, events="v : mark")(4), ValueError, "^t: 4 is not within the motion"),
    (lambda: fvi.Event("x", direction=2), ValueError, "^events: direction: 2"),
    (lambda: fvi.Event(3), TypeError, "^events: 3"), (lambda: fvi.Event("x", 3), TypeError, "^events: action: 3"),
    (lambda: fvi.Event("x", gradient=abs), ValueError, "^events: gradient: a text has its own"),
    (lambda: fvi.Problem(events="x : stop"), TypeError, "fvi.solve takes it"),
    (lambda: fvi.solve(fvi.Problem(M=[[1]], K=[[1]]), events="x : stop"), fvi.Error, "matrices"),
    (lambda: fvi.solve(fvi.Problem(M=[[1]], K=[[1]]), events="x : contact:0"), fvi.Error, "^a system with matrices has no events"),
    (lambda: fvi.vjp(fvi.solve(BALL, events="v : mark"), x=1), fvi.Error, "a run with events has no adjoint"),
])
def test_a_wrong_event_is_named(call, what, why):
    with pytest.raises(what, match=why):
        call()


def test_names_of_let_may_stand_in_an_event():
    s = fvi.solve(BALL.replace(let={"c": 0.5}), events="x - c : stop")
    assert abs(s.x_events[0][0, 0] - 0.5) < 1e-14
    with pytest.raises(ValueError, match="'c' is in no expression"):
        fvi.solve(BALL.replace(let={"c": 0.5}), events="x : stop")


# ---- the ground, and imposed motion ----

def test_a_ground_is_the_programs():
    s = fvi.solve(FRAME.replace(ground="sin(8*t)"), h=0.02, method="fvi-lobatto4")
    names = "x1,x2,v1,v2,a1,a2,ag,d1.force1,d1.force2,d1.work,balance"
    rows, _ = program(*OF_FRAME, "--ground", "sin(8*t)", "--columns", names)
    mine = np.column_stack([s.x, s.v, s.a, s.ag, s.forces["d1"], s.work["d1"], s.balance])
    assert np.array_equal(mine, rows)
    assert not fvi.solve(FRAME, h=0.02, method="fvi-lobatto4").ag.any()


def test_a_ground_is_a_text_a_function_or_arrays(tmp_path):
    def solve(**fields):
        return fvi.solve(FRAME.replace(**fields), h=0.02, method="fvi-lobatto4").x
    assert abs(solve(ground="sin(8*t)") - solve(ground=lambda t: np.sin(8 * t))).max() < 1e-14  # seen: 1e-16
    t, a = np.array([0, 0.5, 1, 1.5, 10]), np.array([0, 0.3, -0.2, 0, 0])
    table = tmp_path / "quake.csv"
    table.write_text("t,ag\n" + "".join(f"{u!r},{b!r}\n" for u, b in zip(t.tolist(), a.tolist())))
    rows, _ = program(*OF_FRAME, "--ground", f"file:{table}", "--columns", "x")
    assert np.array_equal(solve(ground=(t, a)), rows)
    assert np.array_equal(solve(ground=(t, a)), solve(ground=f"file:{table}"))
    rows, _ = program(*OF_FRAME, "--ground", "sin(8*t)", "--along", "0,1", "--force", "cosine:1,2", "--columns", "x")
    assert np.array_equal(solve(ground="sin(8*t)", along=[0, 1], force="cosine:1,2"), rows)
    q = pickle.loads(pickle.dumps(FRAME.replace(ground=(t, a))))
    assert np.array_equal(fvi.solve(q, h=0.02).ag, np.interp(np.arange(501) * 0.02, t, a)) and q != FRAME
    with pytest.raises(ZeroDivisionError):
        solve(ground=lambda t: 1 / 0)
    with pytest.raises(TypeError, match="^ground gave"):
        solve(ground=lambda t: "a")


def test_the_ground_pulls_at_the_matrix_of_masses():
    """-M r a_g as a force of one's own, for matrices that are not diagonal."""
    M, K, r = np.array([[2.0, 0.5], [0.5, 1.0]]), np.array([[200.0, -100], [-100, 100]]), np.array([1.0, 0.5])
    t = np.linspace(0, 5, 26)
    a = np.random.default_rng(4).standard_normal(26)
    shaken = fvi.Problem(M=M, K=K, C=K / 50, order=0.6, time=5, ground=(t, a), along=r)
    pushed = fvi.Problem(M=M, K=K, C=K / 50, order=0.6, time=5, force=(t, -np.outer(a, M @ r)))
    x = fvi.solve(pushed, h=0.01).x
    assert abs(fvi.solve(shaken, h=0.01).x - x).max() < 1e-13 * abs(x).max()  # seen: 2e-15


@pytest.mark.parametrize("method", ["fvi", "fvi-bdf2", "fvi-lobatto4", "fvi-lobatto4d"])
def test_a_ground_may_jump_at_a_row(method):
    """The derivatives by a mass and by a name in the ground are differences of motions; of form D there is none."""
    def end(mass=1.3, A=0.5):
        q = fvi.Problem("harmonic:4", mass=mass, rho=0.5, alpha=0.3, ground="A*sign(1-t)", let={"A": A}, x0=0.2, p0=0.1, time=2)
        return fvi.solve(q, method=method, steps=16)
    s, e = end(), 1e-5
    last = np.zeros_like(s.x)
    last[-1] = 1
    if method == "fvi-lobatto4d":
        with pytest.warns(fvi.FviWarning, match="jumps at a row"):
            assert np.isnan(fvi.vjp(s, x=last, wrt="mass")["mass"])
        return
    by = fvi.vjp(s, x=last, wrt=["mass", "let"])
    assert by["mass"] == pytest.approx((end(mass=1.3 + e).x[-1, 0] - end(mass=1.3 - e).x[-1, 0]) / (2 * e), abs=1e-9)
    assert by["let"]["A"] == pytest.approx((end(A=0.5 + e).x[-1, 0] - end(A=0.5 - e).x[-1, 0]) / (2 * e), abs=1e-9)


def test_a_bob_on_a_rod_hits_a_wall():
    """As the program has it, and as the same pendulum in its angle does."""
    bob = fvi.Problem(lagrangian="(v1^2+v2^2)/2 - x2", constraints="(x1^2+x2^2-1)/2", dampers="x1 : power:0.3,0.3",
                      x0=[1, 0], v0=[0, 0], time=6)
    s = fvi.solve(bob, events=["x1+0.2 : impact:0.7", "v2 : mark"], steps=6, step_error=1e-12)
    rows, said = program("--lagrangian", "(v1^2+v2^2)/2 - x2", "--constraint", "(x1^2+x2^2-1)/2", "--damper", "x1 : power:0.3,0.3",
                         "--x0", "1,0", "--v0", "0,0", "--time", "6", "--steps", "6", "--step-error", "1e-12", "--columns", "t,x,p",
                         "--event", "x1+0.2 : impact:0.7", "--event", "v2 : mark")
    assert np.array_equal(np.column_stack([s.t, s.x, s.p]), rows)
    assert sorted(s.t_events[0].tolist() + s.t_events[1].tolist()) == [float(t) for t, _ in said] and len(said) > 3
    angle = fvi.Problem(lagrangian="v^2/2 + cos(x)", dampers="sin(x) : power:0.3,0.3", x0=np.pi / 2, v0=0, time=6)
    r = fvi.solve(angle, events="sin(x)+0.2 : impact:0.7", steps=6, step_error=1e-12)
    assert abs(s.t_events[0] - r.t_events[0]).max() < 1e-11
    assert abs(s.x[:, 0] - np.sin(r.x[:, 0])).max() < 1e-11


def test_a_coordinate_that_is_imposed_has_a_reaction():
    q = fvi.Problem("(x2-x1)^2/2", impose="x1=sin(t)", constraints="x3 - x2/2", mass=1, x0=[0, 0, 0], v0=[1, 0, 0], time=5)
    s = fvi.solve(q, h=0.01)
    rows, _ = program("--potential", "(x2-x1)^2/2", "--impose", "x1=sin(t)", "--constraint", "x3 - x2/2", "--x0", "0,0,0",
                      "--v0", "1,0,0", "--h", "0.01", "--time", "5", "--columns", "x,reaction1,multiplier1,a1", "--rho", "0.2")
    assert np.array_equal(np.column_stack([s.x, s.reactions["x1"], s.multipliers, s.a[:, 0]]), rows)
    assert s.multipliers.shape == (501, 1) and fvi.solve(BALL, h=0.1).multipliers.shape == (31, 0)


@pytest.mark.parametrize("fields, what, why", [
    (dict(ground=3), TypeError, "^ground: 3 is no text"), (dict(ground="impulse:1,2"), ValueError, "^ground: .*impulse"),
    (dict(along=1), ValueError, "^along: without ground"), (dict(ground="sin(t)", along=[1, 2, 3]), ValueError, "^along has"),
    (dict(ground=([0, 9], [0, 1])), ValueError, "^ground: it is known from 0 to 9"),
    (dict(ground=([0, 9, 3], [0, 1, 2])), ValueError, "^ground: t must increase"),
    (dict(ground=([0, 10], [[0, 1], [0, 1]])), ValueError, "^ground: t and a have the shapes"),
    (dict(ground=(1, 2, 3)), TypeError, r"^ground: a pair \(t, a\)"), (dict(ground="sn(t)"), ValueError, "^ground: "),
])
def test_a_wrong_ground_is_named(fields, what, why):
    with pytest.raises(what, match=why):
        fvi.solve(FRAME.replace(**fields))


def test_a_lagrangian_holds_its_ground_itself():
    with pytest.raises(ValueError, match="^lagrangian: not together with ground"):
        fvi.Problem(lagrangian="v^2/2", x0=0, v0=1, ground="sin(t)")


DRIVEN = fvi.Problem("(x2-x1)^2/2", x0=[0, 0], v0=[1, 0], rho=0.2, alpha=0.3, time=5)


@pytest.mark.parametrize("method", ["fvi-stable", "fvi-lobatto4", "fvi-lobatto3d"])
def test_what_is_imposed_may_be_a_function(method):
    """As the text: its sine is another one, by a rounding."""
    text, own = (fvi.solve(DRIVEN.replace(impose=how), h=0.05, method=method)
                 for how in ("x1=sin(t)", {"x1": lambda t: (np.sin(t), np.cos(t))}))
    assert abs(text.x - own.x).max() < 1e-14 and abs(text.p - own.p).max() < 1e-14
    assert abs(text.reactions["x1"] - own.reactions["x1"]).max() < 1e-11
    exact = [fvi.solve(DRIVEN.replace(x0=[0, 0], v0=[0.5, 0], impose=how), h=0.125, method=method)  # no rounding at all
             for how in ("x1=t/2", {"x1": lambda t: (t / 2, 0.5)}, {"x1": "t/2"})]
    for other in exact[1:]:
        assert np.array_equal(exact[0].x, other.x) and np.array_equal(exact[0].p, other.p)
        assert np.array_equal(exact[0].reactions["x1"], other.reactions["x1"])
    if method != "fvi-lobatto3d":
        a, b = (fvi.vjp(s, x=1.0, wrt=["rho", "alpha", "mass"]) for s in (text, own))
        assert all(abs(np.asarray(a[name]) - b[name]).max() < 1e-12 for name in a)


def test_what_is_imposed_may_be_rows():
    """Of a cubic they are that cubic, on any grid; of a sine an error of order 4, at both ends, too."""
    t = np.array([0, 0.3, 1.1, 2.4, 2.5, 4, 5])
    cubic = fvi.solve(DRIVEN.replace(v0=[1, 0], impose="x1=t-t^2/4+t^3/30"), h=0.05, method="fvi-lobatto4")
    rows = fvi.solve(DRIVEN.replace(v0=[1, 0], impose={"x1": (t, t - t**2 / 4 + t**3 / 30)}), h=0.05, method="fvi-lobatto4")
    assert abs(cubic.x - rows.x).max() < 1e-14 and abs(cubic.reactions["x1"] - rows.reactions["x1"]).max() < 1e-11
    t = np.array([0, 0.4, 0.7, 1.5, 2.1, 3.3, 4.2, 5])
    of = reference_spline(t, np.sin(t) / 2)
    start = DRIVEN.replace(v0=[of(0.0)[1], 0])
    s, r = (fvi.solve(start.replace(impose={"x1": how}), h=0.05, method="fvi-lobatto4") for how in ((t, np.sin(t) / 2), of))
    assert abs(s.x - r.x).max() < 1e-13 and abs(s.reactions["x1"] - r.reactions["x1"]).max() < 1e-10
    assert 1e-4 < abs(s.x[:, 0] - np.sin(s.t) / 2).max() < 0.02
    again = pickle.loads(pickle.dumps(DRIVEN.replace(impose={"x1": (t, t)})))
    assert again == DRIVEN.replace(impose={"x1": (t, t)}) and not again.impose[0][1][0].flags.writeable


def reference_spline(t, x):
    """Place and velocity of cubics whose coefficients are found from all values and joints at once: at the second
    and at the last row but one the third derivatives join, too."""
    n = len(t) - 1
    A, b, row = np.zeros((4 * n, 4 * n)), np.zeros(4 * n), 0

    def put(piece, at, order, value, other=None):
        nonlocal row
        for k in range(order, 4):
            factor = np.prod(range(k - order + 1, k + 1)) if order else 1
            A[row, 4 * piece + k] += factor * (at - t[piece])**(k - order)
            if other is not None:
                A[row, 4 * other + k] -= factor * (at - t[other])**(k - order)
        b[row] = value
        row += 1
    for i in range(n):
        put(i, t[i], 0, x[i])
        put(i, t[i + 1], 0, x[i + 1])
    for i in range(1, n):
        put(i - 1, t[i], 1, 0, i)
        put(i - 1, t[i], 2, 0, i)
    put(0, t[1], 3, 0, 1)
    put(n - 2, t[n - 1], 3, 0, n - 1)
    c = np.linalg.solve(A, b).reshape(n, 4)

    def at(time):
        i = min(max(np.searchsorted(t, time, side="right") - 1, 0), n - 1)
        return tuple(sum(c[i, k] * f * (time - t[i])**e for k, f, e in terms) for terms in (
            [(k, 1, k) for k in range(4)], [(k, k, k - 1) for k in range(1, 4)]))
    return at


@pytest.mark.parametrize("impose, what, why", [
    ({"x1": 3}, TypeError, "^impose: x1: 3 is no text, no function"), ({"y": abs}, ValueError, "^impose: 'y' is no coordinate"),
    ({"x3": lambda t: (t, 1)}, ValueError, "x0 has the shape"), ([3], TypeError, "^impose: 3"), (("x1", abs), TypeError, "^impose: <built-in"),
    ({"x1": ([0, 1, 2, 5], [0, 1, 2])}, ValueError, "^impose: x1: t and x have the shapes"),
    ({"x1": ([0, 1, 5], [0, 1, 2])}, ValueError, "not .n,. with n >= 4"), ({"x1": ([0, 1, 2, 4], [0, 1, 2, 3])}, ValueError, "^impose: x1: it is known from 0 to 4"),
    ({"x1": ([0, 2, 1, 5], [0, 1, 2, 3])}, ValueError, "^impose: x1: t must increase"), ({"x1": lambda t: t}, TypeError, "^impose: x1 gave 0.0, not a place and a velocity"),
    ({"x1": lambda t: (t, "a")}, TypeError, "^impose: x1 gave"), ({"x1": lambda t: 1 / 0}, ZeroDivisionError, ""),
    ({"x1": lambda t: (1 + t, 1)}, fvi.Error, "constraint 'x1', which is -1 there"),
])
def test_a_wrong_imposed_motion_is_named(impose, what, why):
    with pytest.raises(what, match=why):
        fvi.solve(DRIVEN.replace(impose=impose), h=0.1)
