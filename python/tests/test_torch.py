"""The rendering loss in PyTorch against the core."""

import json
import os
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import svbrdf
from conftest import golden_materials, maps

if os.environ.get("SVBRDF_NEEDS_TORCH"):
    import torch
else:
    torch = pytest.importorskip("torch", reason="PyTorch is not installed")
import svbrdf.torch as sv

# Threads that wait for each other take long where other programs run.
torch.set_num_threads(1)

DTYPES = {"f64": torch.float64, "f32": torch.float32}
BOUNDS = {"f64": 1e-12, "f32": 1e-5}


def tensors(material: svbrdf.Material) -> Any:
    """The maps of a material, channels first."""

    def channels_first(array: Any) -> Any:
        return torch.from_numpy(np.ascontiguousarray(np.moveaxis(np.atleast_3d(array), -1, 0)))

    return sv.Maps(*(channels_first(getattr(material, name)) for name in sv.Maps._fields))


def converted(given: Any, dtype: Any) -> Any:
    return sv.Maps(*(map.to(dtype) for map in given))


def random_maps(seed: int, height: int = 6, width: int = 8, dtype: Any = torch.float64) -> Any:
    return converted(tensors(svbrdf.Material(**maps(height, width, seed, np.float64), precision="f64")), dtype)


def point(row: dict[str, Any], dtype: Any) -> Any:
    """A golden point as maps of one texel and a scene."""

    def map_of(values: Any) -> Any:
        return torch.tensor(values, dtype=torch.float64).reshape(-1, 1, 1).to(dtype)

    given = sv.Maps(*(map_of(row[key]) for key in ("n", "d", "s", "r")))
    return given, svbrdf.Scene("distant", tuple(row["v"]), tuple(row["l"]))


@pytest.mark.parametrize(("key", "convention"), [("expected", "printed"), ("expected_guided_2020", "guided-2020")])
@pytest.mark.parametrize("precision", ["f64", "f32"])
def test_golden_points_are_met(points: list[dict[str, Any]], key: str, convention: str, precision: str) -> None:
    """Within 1e-12 and 1e-5, times the condition number of the point where it is above 100."""
    unit = {"f64": 2.0**-53, "f32": 2.0**-24}[precision]
    checked, worst, of_well_conditioned = 0, 0.0, 0.0
    for row in points:
        given, scene = point(row, DTYPES[precision])
        got = sv.render(given, scene, svbrdf.CONVENTIONS[convention]).double().flatten().numpy()
        assert np.isfinite(got).all(), row["id"]
        kappa = row["kappa"]
        # As in the tests of the core: the problem itself is too ill-conditioned, or the floor of the roughness acts.
        if row["check"] != "ok" or row[key] is None or row["cat"].startswith("r0_at_mirror"):
            continue
        if precision == "f32" and (kappa is None or kappa > 1e5):
            continue
        # The top of a highlight that is narrower than the rounding of a direction.
        if precision == "f32" and row["cat"] == "peak_x0" and row["r"] ** 2 < unit:
            continue
        bound = max(BOUNDS[precision], 16 * max(kappa or 1, 1) * unit)
        expected = np.array(row[key])
        error = np.abs(got - expected) / np.maximum(np.abs(expected), 1e-300)
        error[expected == got] = 0
        assert (error <= bound).all(), (row["id"], row["cat"], error, bound)
        checked += 1
        worst = max(worst, error.max() / bound)
        if (kappa or 1) <= 100:
            of_well_conditioned = max(of_well_conditioned, error.max())
    print(f"\ngolden points, {convention}, {precision}: {of_well_conditioned:.1e}")
    assert checked > 100
    assert worst > 0


@pytest.mark.parametrize("convention", svbrdf.CONVENTIONS)
@pytest.mark.parametrize("precision", ["f64", "f32"])
def test_the_loss_is_that_of_the_core_for_the_same_seed(precision: Any, convention: str) -> None:
    ground_truth, prediction, _ = svbrdf.built_in(precision="f64")
    small = [
        svbrdf.Material(**{name: getattr(m, name)[40:72, 100:148] for name in sv.Maps._fields}, precision="f64")
        for m in (ground_truth, prediction)
    ]
    for sampler in ("random", "sobol"):
        papers: dict[str, Any] = {"near": 6, "distant": 3, "sampler": sampler}
        expected = svbrdf.loss(*small, seed=3, convention=convention, precision="f64", **papers).results[0].loss
        given = [converted(tensors(m), DTYPES[precision]) for m in small]
        got = sv.RenderingLoss(convention=convention, sampler=sampler)(given[1], given[0], seed=3).item()
        print(f"\nloss of seed 3, {convention}, {sampler}, {precision}: {abs(got / expected - 1):.1e}")
        assert got == pytest.approx(expected, rel=BOUNDS[precision])
        assert sv.RenderingLoss(convention=convention)(given[1], given[0], seed=4).item() != pytest.approx(expected)


@pytest.mark.parametrize("convention", [name for name, one in svbrdf.CONVENTIONS.items() if one.smith])
def test_the_loss_is_that_of_the_core_and_a_changed_term_is_seen(convention: str) -> None:
    ground_truth, prediction, _ = svbrdf.built_in()
    expected = svbrdf.loss(ground_truth, prediction, near=2, distant=2, convention=convention).results[0].loss
    scenes = svbrdf.sample_scenes(2, 2, convention=convention)
    got, truth = tensors(prediction), tensors(ground_truth)
    chosen = svbrdf.CONVENTIONS[convention]
    assert sv.scene_losses(got, truth, scenes, chosen).mean().item() == pytest.approx(expected, rel=1e-6)
    assert chosen.smith
    for changed in (
        replace(chosen.smith, is_weighted=not chosen.smith.is_weighted),
        replace(chosen.smith, specular=0.05),
        replace(chosen.smith, cosine_floor=0.05),
        replace(chosen.smith, intensity_distant=1.0),
    ):
        other = sv.scene_losses(got, truth, scenes, replace(chosen, smith=changed)).mean().item()
        assert other != pytest.approx(expected, rel=1e-5), changed


@pytest.mark.parametrize("precision", ["f64", "f32"])
def test_the_golden_losses_are_met(golden: Path, precision: Any) -> None:
    worst = 0.0
    # In all conventions on small maps; large ones take long.
    conventions = {
        "S1": ["printed"],
        "S3": ["multi-image-2019"],
        "S5": list(svbrdf.CONVENTIONS)[:4],
        "S6": ["guided-2020"],
    }
    for path in sorted((golden / "loss").glob("*.json")):
        case = json.loads(path.read_text())
        scenes = svbrdf.read_scenes(golden / "scenes" / path.name)
        materials = golden_materials(golden, case, "f64")
        ground_truth, prediction = (converted(tensors(m), DTYPES[precision]) for m in materials)
        for name in conventions.get(path.name[:2], []):
            expected = case["expected"][name]
            got = sv.RenderingLoss(convention=name, scenes=scenes)(prediction, ground_truth).item()
            core = svbrdf.loss(*materials, scenes=scenes, convention=name, precision="f64").results[0].loss
            worst = max(worst, abs(got - core) / core)
            assert got == pytest.approx(expected["loss"], rel=max(1e-9, BOUNDS[precision]))
    print(f"\ngolden losses, {precision}: {worst:.1e}")
    assert 0 < worst < BOUNDS[precision]


def test_batches_are_rendered_like_single_materials() -> None:
    a, b, c = (random_maps(seed) for seed in range(3))
    scenes = svbrdf.sample_scenes(2, 2)
    convention = svbrdf.CONVENTIONS["printed"]
    batch = sv.Maps(*(torch.stack([x, y]) for x, y in zip(a, b, strict=True)))
    losses = sv.scene_losses(batch, c, scenes, convention)
    assert losses.shape == (4, 2)
    for i, one in enumerate((a, b)):
        torch.testing.assert_close(losses[:, i], sv.scene_losses(one, c, scenes, convention))


@pytest.mark.parametrize("convention", svbrdf.CONVENTIONS)
def test_gradients_are_those_of_finite_differences(convention: str) -> None:
    """Central differences of the loss along each value of a texel, at normals of any length, away from clamps."""
    prediction, ground_truth = random_maps(0, 3, 3), random_maps(1, 3, 3)
    prediction = prediction._replace(roughness=0.3 + 0.6 * prediction.roughness, normal=2.5 * prediction.normal)
    leaves = [map.clone().requires_grad_() for map in prediction]
    loss = sv.RenderingLoss(convention=convention, scenes=svbrdf.sample_scenes(convention=convention))
    loss(sv.Maps(*leaves), ground_truth).backward()
    step = 1e-6
    for index, leaf in enumerate(leaves):
        for place in range(leaf.numel()):
            values = []
            for sign in (1, -1):
                moved = [map.clone() for map in prediction]
                moved[index].view(-1)[place] += sign * step
                values.append(loss(sv.Maps(*moved), ground_truth).item())
            expected = (values[0] - values[1]) / (2 * step)
            got = leaf.grad.view(-1)[place].item()
            assert got == pytest.approx(expected, rel=1e-3, abs=1e-8), (sv.Maps._fields[index], place)


@pytest.mark.parametrize("convention", svbrdf.CONVENTIONS)
@pytest.mark.parametrize("precision", ["f64", "f32"])
def test_no_gradient_is_nan(precision: Any, convention: str) -> None:
    """At roughness 0 and 1, black and white texels, h = n, l = -v, normals away from the light and without length."""
    dtype = DTYPES[precision]
    slanted = (0.6, 0.0, 0.8)
    scenes = [
        svbrdf.Scene("distant", (0, 0, 1), (0, 0, 1)),
        svbrdf.Scene("distant", slanted, (-0.6, 0.0, 0.8)),
        svbrdf.Scene("distant", slanted, (-0.6, 0.0, -0.8)),
        svbrdf.Scene("distant", (0.6, 0.8, 0.0), (-0.6, -0.8, 0.0)),
        svbrdf.Scene("distant", (1, 0, 1e-6), (-1, 0, 1e-6)),
        svbrdf.Scene("near", (0, 0, 1), (0, 0, 1)),
        svbrdf.Scene("near", (0, 0, 1e-3), (0, 0, 1e-3)),
    ]
    normals = [(0, 0, 1), slanted, (-1, 0, 0), (0, 0, -1), (1, 0, 1e-3), (0, 0, 0)]
    texels = [(n, d, s, r) for n in normals for d in (0, 1) for s in (0, 1) for r in (0, 1e-4, 0.5, 1)]

    def map_of(values: list[Any]) -> Any:
        return torch.tensor(values, dtype=dtype).reshape(len(values), -1, 1, 1).requires_grad_()

    given = sv.Maps(
        map_of([n for n, _, _, _ in texels]),
        map_of([[d] * 3 for _, d, _, _ in texels]),
        map_of([[s] * 3 for _, _, s, _ in texels]),
        map_of([r for *_, r in texels]),
    )
    target = sv.Maps(*(torch.full_like(map, 0.3).detach() for map in given))
    losses = sv.scene_losses(given, target, scenes, svbrdf.CONVENTIONS[convention])
    assert torch.isfinite(losses).all()
    losses.mean().backward()
    for name, leaf in zip(sv.Maps._fields, given, strict=True):
        assert torch.isfinite(leaf.grad).all(), name
    smith = svbrdf.CONVENTIONS[convention].smith
    # One renderer takes no specular map.
    used = [
        leaf
        for name, leaf in zip(sv.Maps._fields, given, strict=True)
        if name != "specular" or not smith or smith.specular is None
    ]
    assert all(leaf.grad.abs().sum() > 0 for leaf in used)
    above = [scene for scene in scenes if min(scene.view[2], scene.light[2]) > 0]
    loss, added_up = gradients(sv.RenderingLoss(convention=convention, scenes=above, check=False), given, target)
    assert torch.isfinite(loss)
    assert all(torch.isfinite(gradient).all() for gradient in added_up)


def gradients(compute: Any, *materials: Any) -> tuple[Any, list[Any]]:
    """The value and its gradients with respect to all maps."""
    copies = [sv.Maps(*(map.detach().clone().requires_grad_() for map in maps)) for maps in materials]
    value = compute(*copies)
    value.backward()
    return value.detach(), [map.grad for maps in copies for map in maps]


@pytest.mark.parametrize("convention", svbrdf.CONVENTIONS)
def test_the_gradient_of_the_loss_is_that_of_the_losses_of_the_scenes(convention: str) -> None:
    """The module adds up the gradient scene by scene. The ground truth may need one, and has its own batch."""
    a, b, ground_truth = (random_maps(seed) for seed in range(3))
    batch = sv.Maps(*(torch.stack(pair) for pair in zip(a, b, strict=True)))
    scenes = svbrdf.sample_scenes(2, 2, convention=convention)
    loss = sv.RenderingLoss(convention=convention, scenes=scenes)
    got = gradients(lambda p, g: 3 * loss(p, g), batch, ground_truth)
    chosen = svbrdf.CONVENTIONS[convention]
    expected = gradients(lambda p, g: 3 * sv.scene_losses(p, g, scenes, chosen).mean(), batch, ground_truth)
    for found, other in zip((got[0], *got[1]), (expected[0], *expected[1]), strict=True):
        torch.testing.assert_close(found, other, rtol=1e-12, atol=1e-14)
    with torch.no_grad():
        torch.testing.assert_close(3 * loss(batch, ground_truth), got[0], rtol=1e-12, atol=0)


def test_shapes_that_would_broadcast_to_a_wrong_loss_are_refused() -> None:
    batch = sv.Maps(*(torch.stack(several) for several in zip(*(random_maps(seed) for seed in (1, 2, 3)), strict=True)))
    one, of_one = (sv.Maps(*(map[part] for map in batch)) for part in (0, slice(1)))
    loss = sv.RenderingLoss()
    for match, changed in (
        # Of three materials: three channels by chance.
        ("roughness: expected ... x 1 x 6 x 8, found 3 x 6 x 8", {"roughness": batch.roughness[:, 0]}),
        ("roughness: expected .*, found 3 x 3 x 6 x 8", {"roughness": batch.roughness.expand(-1, 3, -1, -1)}),
        ("specular: expected ... x 3 x 6 x 8, found 3 x 1 x 6 x 8", {"specular": batch.specular[:, :1]}),
        # Near-field scenes would see one texel.
        (": expected ... x 3 x [61] x [81], found", {"normal": batch.normal[..., :1, :1]}),
        ("diffuse: expected the batch dimensions of .*normal, 3, or none, found 1 x", {"diffuse": of_one.diffuse}),
    ):
        wrong = batch._replace(**changed)
        for pair in ((wrong, batch), (batch, wrong)):
            for compute in (loss, lambda p, g: sv.scene_losses(p, g, svbrdf.sample_scenes(1, 1), loss.convention)):
                with pytest.raises(ValueError, match=match):
                    compute(*pair)
    with pytest.raises(ValueError, match="diffuse: expected"):
        sv.render(batch._replace(diffuse=batch.diffuse[..., :4]), svbrdf.sample_scenes()[0], loss.convention)
    with pytest.raises(ValueError, match=r"ground_truth.normal: expected the batch dimensions of prediction.normal, 3"):
        loss(batch, of_one)
    # One ground truth for a batch is no mistake where it has no batch dimension.
    assert loss(batch, one).item() > 0
    assert loss(one, batch).item() > 0


def test_what_is_no_material_is_refused_by_the_name_of_the_argument() -> None:
    maps, loss = random_maps(0), sv.RenderingLoss()
    for pair, match in (
        ((maps._asdict(), maps), r"prediction: expected svbrdf.torch.Maps, found dict; make one by Maps\(normal="),
        ((maps, maps.normal), "ground_truth: expected svbrdf.torch.Maps, found Tensor"),
        ((maps, maps._replace(diffuse=maps.diffuse.numpy())), "ground_truth.diffuse: expected a tensor, found ndarray"),
    ):
        with pytest.raises(TypeError, match=match):
            loss(*pair)


def test_values_are_checked_in_the_first_call_by_the_name_of_the_map() -> None:
    maps = random_maps(0)
    nan, no_length = maps.roughness.clone(), maps.normal.clone()
    nan[0, 0, 1], no_length[:, 2, 3:5] = float("nan"), 0
    for match, changed in (
        (r"diffuse: expected values in \[0, 1\], found .* to 2\d\d; scale or clamp", {"diffuse": 255 * maps.diffuse}),
        (r"specular: expected .*, found -0.\d+ to 0.\d+; scale or clamp", {"specular": 2 * maps.specular - 1}),
        ("roughness: 1 of 48 values are NaN or infinite", {"roughness": nan}),
        ("normal: 2 of 48 normals have no length, and so no gradient; give", {"normal": no_length}),
    ):
        wrong = maps._replace(**changed)
        for which, pair in (("prediction", (wrong, maps)), ("ground_truth", (maps, wrong))):
            loss = sv.RenderingLoss()
            # What is refused is looked at again.
            for _ in range(2):
                with pytest.raises(ValueError, match=f"^{which}.{match}"):
                    loss(*pair)
            loss(maps, maps)
            loss(*pair)
            sv.RenderingLoss(check=False)(*pair)


def test_normals_in_0_to_1_are_warned_of_once() -> None:
    maps = random_maps(0)
    stored = maps._replace(normal=(torch.nn.functional.normalize(maps.normal, dim=0) + 1) / 2)
    batch = sv.Maps(*(torch.stack([map, map]) for map in stored))
    loss = sv.RenderingLoss()
    with pytest.warns(
        svbrdf.AssumptionWarning, match="prediction.normal: no x or y is .*; give 2 .* normal - 1"
    ) as told:
        loss(batch, maps)
    assert len(told) == 1
    # Warnings are errors here.
    loss(batch, maps)
    sv.RenderingLoss(check=False)(batch, maps)


def test_scenes_that_a_loss_has_no_use_for_are_refused() -> None:
    below = svbrdf.Scene("distant", (0, 0, 1), (0, 0, -1))
    with pytest.raises(ValueError, match=r"scene 1: its light \(0, 0, -1\) is not above the plane"):
        sv.RenderingLoss(scenes=[*svbrdf.sample_scenes(1, 0), below])
    with pytest.raises(ValueError, match="scenes: expected at least one"):
        sv.RenderingLoss(scenes=[])
    with pytest.raises(ValueError, match="unknown convention `none`; use one of: printed, single-image-2018"):
        sv.RenderingLoss(convention="none")


def test_each_call_has_new_scenes_which_the_generator_of_torch_repeats() -> None:
    materials = [random_maps(seed) for seed in range(2)]
    loss = sv.RenderingLoss()

    def losses(seed: int | None = None) -> list[float]:
        return [loss(*materials, seed=seed).item() for _ in range(3)]

    torch.manual_seed(5)
    first = losses()
    assert len(set(first)) == 3
    assert len({*first, *losses()}) == 6
    torch.manual_seed(5)
    assert losses() == first
    assert len(set(losses(seed=3))) == 1
    # Seeds and given scenes leave the generator alone.
    torch.manual_seed(5)
    loss(*materials, seed=3)
    sv.RenderingLoss(scenes=svbrdf.sample_scenes())(*materials)
    assert losses() == first
    # 0 was the seed of every call.
    assert loss(*materials, seed=0).item() not in first


@pytest.mark.parametrize("convention", svbrdf.CONVENTIONS)
@pytest.mark.parametrize("precision", ["f64", "f32"])
def test_straight_through_keeps_the_gradients_of_values_at_their_limits(precision: Any, convention: str) -> None:
    ground_truth = converted(random_maps(1), DTYPES[precision])
    chosen = svbrdf.CONVENTIONS[convention]
    loss = sv.RenderingLoss(convention=convention, scenes=svbrdf.sample_scenes(convention=convention))
    through = sv.RenderingLoss(convention=convention, scenes=loss.scenes, straight_through=True, check=False)
    # Values within their limits have the same loss and gradient.
    inside = converted(random_maps(0), DTYPES[precision])
    for got, expected in zip(
        gradients(through, inside, ground_truth)[1], gradients(loss, inside, ground_truth)[1], strict=True
    ):
        torch.testing.assert_close(got, expected, rtol=0, atol=0)
    beyond = inside._replace(**{name: 3 * getattr(inside, name) - 1 for name in ("diffuse", "specular", "roughness")})
    limited = beyond._replace(
        diffuse=beyond.diffuse.clamp(0, 1),
        specular=beyond.specular.clamp(0, 1),
        roughness=beyond.roughness.clamp(chosen.roughness_floor, 1),
    )
    assert through(beyond, ground_truth) == loss(limited, ground_truth)
    dead = beyond.roughness < chosen.roughness_floor
    assert 0 < dead.sum() < dead.numel()
    of_beyond = gradients(through, beyond, ground_truth)[1][:4]
    assert all(torch.isfinite(gradient).all() for gradient in of_beyond)
    assert (of_beyond[3][dead] != 0).any()
    assert (of_beyond[1][beyond.diffuse < 0] != 0).any()
    # Without, roughness below its floor has none.
    below = limited._replace(roughness=beyond.roughness.clamp(-1, 1))
    unlimited = sv.RenderingLoss(convention=convention, scenes=loss.scenes, check=False)
    assert (gradients(unlimited, below, ground_truth)[1][3][dead] == 0).all()


def test_half_precision_is_computed_in_float32() -> None:
    prediction, ground_truth = (random_maps(seed, dtype=torch.float16) for seed in range(2))
    loss = sv.RenderingLoss(scenes=svbrdf.sample_scenes())
    got, of_half = gradients(loss, prediction, ground_truth)
    expected, of_single = gradients(loss, *(converted(m, torch.float32) for m in (prediction, ground_truth)))
    assert got == expected
    for half, single in zip(of_half, of_single, strict=True):
        assert half.dtype == torch.float16
        torch.testing.assert_close(half, single.half())


@pytest.mark.skipif(not hasattr(torch, "compiler"), reason="this PyTorch has no compiler")
def test_the_compiled_loss_is_the_same_and_compiles_once_for_all_seeds() -> None:
    materials = [random_maps(seed) for seed in range(2)]
    loss = sv.RenderingLoss()
    compilations = 0

    def backend(graph: Any, inputs: Any) -> Any:
        nonlocal compilations
        compilations += 1
        return graph.forward

    torch.compiler.reset()
    compiled = torch.compile(loss, backend=backend)
    for seed in range(4):
        expected = gradients(lambda p, g, seed=seed: loss(p, g, seed=seed), *materials)
        got = gradients(lambda p, g, seed=seed: compiled(p, g, seed=seed), *materials)
        for found, other in zip((got[0], *got[1]), (expected[0], *expected[1]), strict=True):
            torch.testing.assert_close(found, other, rtol=1e-11, atol=1e-13)
    values = []
    for compute in (loss, compiled):
        torch.manual_seed(7)
        values.append([gradients(compute, *materials)[0].item() for _ in range(3)])
    assert values[1] == pytest.approx(values[0], rel=1e-11)
    assert len(set(values[1])) == 3
    # Seeds and no seed, with the check of the first call and without.
    assert compilations == 1


def test_tensors_are_materials_of_the_core() -> None:
    given = maps(4, 5)
    material = svbrdf.Material(**{name: torch.from_numpy(array).requires_grad_() for name, array in given.items()})
    np.testing.assert_array_equal(material.diffuse, svbrdf.Material(**given).diffuse)


@pytest.mark.skipif(not torch.cuda.is_available(), reason="PyTorch has no CUDA device")
def test_the_loss_is_the_same_on_a_cuda_device() -> None:
    a, b = random_maps(0), random_maps(1)
    loss = sv.RenderingLoss(scenes=svbrdf.sample_scenes())
    on_device = loss(sv.Maps(*(m.cuda() for m in a)), sv.Maps(*(m.cuda() for m in b))).item()
    assert on_device == pytest.approx(loss(a, b).item(), rel=1e-12)


def test_the_training_loop_of_the_page_trains(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    page = Path(__file__).parents[2] / "docs/training.md"
    loop, save = [block.split("```")[0] for block in page.read_text(encoding="utf-8").split("```python\n")[1:]]
    truth = sv.Maps(*(map[None] for map in random_maps(1, dtype=torch.float32)))
    network, photographs = torch.nn.Conv2d(3, 10, 1), torch.rand(1, 3, 6, 8)
    held_out, before = SimpleNamespace(photographs=photographs, truth=truth), network.weight.detach().clone()
    exec(loop, {"network": network, "batches": 3 * [(photographs, truth)], "held_out": held_out})
    assert float(capsys.readouterr().out.split()[1]) > 0
    assert not torch.equal(network.weight, before), "the gradient reaches the network"
    scope: dict[str, Any] = {}
    exec(save, scope)
    prediction = converted(random_maps(2), torch.float32)
    scope["save"](prediction, tmp_path / "wood_step000100.png")
    written = svbrdf.read(tmp_path / "wood_step000100.png")
    assert np.abs(prediction.roughness[0].numpy() - written.roughness).max() <= 0.51 / 255
    assert np.abs(prediction.diffuse.permute(1, 2, 0).numpy() - written.diffuse).max() <= 0.51 / 255
