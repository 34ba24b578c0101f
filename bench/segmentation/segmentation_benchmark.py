# SPDX-License-Identifier: MIT
"""The tasks of segmentation_scores.py: scores, times, curves, cross-validation, pictures."""
import concurrent.futures
import itertools
import sys

import numpy

import label_pictures
import perturbations
import point_clouds
import segmentation_metrics
import segmentation_tables
from measuring import Limits, Meter
from segmentation_programs import ours

TRUTHS = {"objects": False, "parts": True}
OURS = ("", "--parts", "--method paper")


class Benchmark:
    def __init__(self, arguments, folder):
        self.arguments, self.folder = arguments, folder
        self.camera = point_clouds.Pinhole()
        self.paths = [
            path
            for path in sorted(arguments.scenes.glob("*.pcd"), key=lambda p: (len(p.stem), p.stem))
            if arguments.frames is None or path.stem in arguments.frames
        ]
        if not self.paths:
            raise SystemExit(f"{arguments.scenes}: no such frames")
        self._scenes = {}
        self._numbers = itertools.count()
        programs = [
            ours(arguments.build, options) for options in arguments.ours or OURS
        ] + arguments.peer
        self.programs = [
            program
            for program in programs
            if not arguments.only or any(program.name == name for name in arguments.only)
        ]

    def scene(self, path):
        if path not in self._scenes:
            self._scenes[path] = point_clouds.read_scene(path)
        return self._scenes[path]

    def _fresh(self):
        return self.folder / str(next(self._numbers))

    def each(self, do, items):
        """Calls do(item) for all items on --jobs threads, and returns the results in the order of
        the items."""
        with concurrent.futures.ThreadPoolExecutor(self.arguments.jobs) as pool:
            return list(pool.map(do, items))

    def images(self, scene, *labels):
        """Labels as images; the points of a frame without rows and columns are placed on the
        camera's pixels."""
        if scene.organised:
            return [array.reshape(scene.height, scene.width) for array in labels]
        return [self.camera.image(scene, array) for array in labels]

    def labels(self, program, path, scene):
        labels = program.labels(path, self._fresh())
        if len(labels) != len(scene.truth):
            raise RuntimeError(
                f"{program.name}: {path.name}: {len(labels)} labels of {len(scene.truth)} points"
            )
        return labels

    def scores_of(self, program, path):
        scene = self.scene(path)
        truth, labels = self.images(scene, scene.truth, self.labels(program, path, scene))
        if program.makes_supervoxels:
            return {"supervoxels": segmentation_metrics.supervoxel_scores(truth, labels).as_dict()}
        return {
            name: segmentation_metrics.score(truth, labels, parts).as_dict()
            for name, parts in TRUTHS.items()
        }

    def scores(self, program):
        return dict(
            zip(
                [path.stem for path in self.paths],
                self.each(lambda path: self.scores_of(program, path), self.paths),
            )
        )

    def times(self):
        """The least CPU seconds and the largest peak memory of each program for each frame, and the
        least seconds of each stage. The programs take turns."""
        meter = Meter(self.arguments.build / "bench/bench_run", Limits(self.arguments.time_limit))
        result = {program.name: {} for program in self.programs}
        for path in self.paths:
            for program in self.programs * self.arguments.times:
                folder = self._fresh()
                folder.mkdir()
                run = meter.run(program.command(path, folder))
                if not run.ok:
                    raise RuntimeError(f"{program.name}: {path.name}: {run.outcome}")
                stages = program.stages(path, folder)
                known = result[program.name].setdefault(
                    path.stem, {"cpu": run.cpu, "peak_mb": 0.0, "stages": stages}
                )
                known["cpu"] = min(known["cpu"], run.cpu)
                known["peak_mb"] = max(known["peak_mb"], run.peak)
                known["stages"] = {
                    name: min(known["stages"][name], stages[name]) for name in stages
                }
                for file in folder.iterdir():
                    file.unlink()
        return result

    def _perturbed_scores(self, kind, amount, path):
        scene = perturbations.perturbed(self.scene(path), kind, amount)
        folder = self._fresh()
        folder.mkdir()
        made = folder / path.name
        point_clouds.write_scene(made, scene)
        result = {}
        for program in self.programs:
            labels = self.labels(program, made, scene)
            result[program.name] = {
                name: segmentation_metrics.score(scene.truth, labels, parts, False).f
                for name, parts in TRUTHS.items()
            }
        made.unlink()
        return result

    def curve(self, kind, amount):
        """The mean F over all frames that were degraded in this way, for each program and truth."""
        frames = self.each(lambda path: self._perturbed_scores(kind, amount, path), self.paths)
        return {
            program.name: {
                name: segmentation_tables.mean(frame[program.name][name] for frame in frames)
                for name in TRUTHS
            }
            for program in self.programs
        }

    def grid_scores(self, truth, options):
        """The score F of each frame when ph-segment runs with these options."""
        program = ours(self.arguments.build, f"--no-check --{truth} {options}")

        def f(path):
            scene = self.scene(path)
            labels = self.labels(program, path, scene)
            return segmentation_metrics.score(scene.truth, labels, TRUTHS[truth], False).f

        return dict(zip([path.stem for path in self.paths], self.each(f, self.paths)))

    def cross_validation(self, truth, categories):
        """Scores each category with the options that have the best mean on the other categories."""
        options = self.arguments.grid
        f = {}
        for values in itertools.product(*options.values()):
            words = " ".join(f"--{name} {value}" for name, value in zip(options, values))
            f[words] = self.grid_scores(truth, words)
            print(
                f"{truth}: {words}: {segmentation_tables.mean(f[words].values()):.4f}",
                file=sys.stderr,
                flush=True,
            )
        return cross_validated(f, categories) | {
            "grid": options,
            "best": max(segmentation_tables.mean(frames.values()) for frames in f.values()),
        }

    def pictures(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        for path in self.paths:
            scene = self.scene(path)
            truth, *labels = self.images(
                scene, scene.truth, *(self.labels(p, path, scene) for p in self.programs)
            )
            points = None
            if self.arguments.shaded:
                points = numpy.stack(self.images(scene, *scene.points.T), axis=2)
            label_pictures.write(
                folder / f"{path.stem}.png", label_pictures.beside(truth, labels, points=points)
            )
        print(
            f"{folder}: ground truth | {' | '.join(p.name for p in self.programs)}", file=sys.stderr
        )


def cross_validated(f, categories):
    """Scores each category with the choice that is best on the other categories. @param f the score
    F of each frame, for each choice. Among equally good choices, the first one is used."""
    groups, chosen, scores = sorted(set(categories.values())), {}, {}
    of = lambda options, kept: segmentation_tables.mean(
        v for frame, v in f[options].items() if kept(categories[frame])
    )
    for group in groups:
        best = max(f, key=lambda options: of(options, lambda c: c != group))
        chosen[group] = {"options": best, "f": of(best, lambda c: c != group)}
        scores[group] = of(best, lambda c: c == group)
    sizes = {group: sum(c == group for c in categories.values()) for group in groups}
    scores["all"] = sum(scores[group] * sizes[group] for group in groups) / sum(sizes.values())
    return {"f": scores, "chosen": chosen}
