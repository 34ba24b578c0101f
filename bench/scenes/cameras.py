# SPDX-License-Identifier: MIT
"""Cameras that see solids: exact depth by casting a ray per pixel, and then the errors of a sensor.

A camera looks along its z axis; x is to the right and y is down. The errors follow publications on
such sensors: axial noise that grows with depth² and rounding of disparity (Khoshelham & Elberink,
2012; Nguyen, Izadi & Lovell, 2012), the shadow of the projector, ragged edges, and mixed pixels."""

import dataclasses
import math

import numpy

NEAREST, FARTHEST = 0.3, 6.0  # metres: the range that all three kinds of sensor measure
GRAZING = 0.09  # cosine of the angle to the normal; flatter rays return nothing


@dataclasses.dataclass(frozen=True)
class Sensor:
    """The optics and the errors of one kind of camera, a pinhole without distortion."""

    width: int
    height: int
    focal: float  # pixels
    baseline: float  # metres between camera and projector; 0: none, and thus no shadow
    disparity_noise: float  # pixels, standard deviation; 0: time-of-flight noise
    disparity_step: float  # pixels; disparities are multiples of it
    smooth: int  # passes of a filter that correlates the noise of neighbours
    ragged: float  # pixels, standard deviation of the place that a pixel measures
    mixed: float  # share of the pixels at an edge that mix its two depths
    noise: tuple = (0.0, 0.0)  # time-of-flight noise: metres, and metres per metre
    depth_step: float = 0.0  # metres; depths are multiples of it

    def spread(self, depth):
        """The standard deviation of the depth that is measured on a surface, in metres."""
        rounding = 1 / 12**0.5  # of numbers that are rounded to multiples of 1
        if self.disparity_noise > 0:
            disparity = math.hypot(self.disparity_noise, rounding * self.disparity_step)
            noise = disparity * depth**2 / (self.focal * self.baseline)
        else:
            noise = self.noise[0] + self.noise[1] * depth
        return numpy.hypot(noise, rounding * self.depth_step)


SENSORS = {
    "structured-light": Sensor(640, 480, 525, 0.075, 0.055, 1 / 8, 1, 0.6, 0.05),
    "active-stereo": Sensor(640, 480, 460, 0.05, 0.06, 1 / 32, 2, 0.8, 0.25, depth_step=0.001),
    "time-of-flight": Sensor(
        640, 576, 504, 0.0, 0.0, 0.0, 0, 0.2, 0.6, noise=(0.0008, 0.0008), depth_step=0.001
    ),
}


@dataclasses.dataclass(frozen=True)
class View:
    """A sensor at a place in the world. `turn` maps directions of the world to the camera."""

    sensor: Sensor
    eye: numpy.ndarray
    turn: numpy.ndarray

    @staticmethod
    def towards(sensor, eye, target, roll=0.0):
        """A camera at `eye` that looks at `target`, with z up in the world.

        @param roll the angle, in radians, by which it is then turned about its axis."""
        eye = numpy.asarray(eye, float)
        forward = numpy.asarray(target, float) - eye
        forward /= numpy.linalg.norm(forward)
        right = numpy.cross(forward, (0, 0, 1))
        right /= numpy.linalg.norm(right)
        turn = numpy.stack([right, numpy.cross(forward, right), forward])
        c, s = math.cos(roll), math.sin(roll)
        return View(sensor, eye, numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) @ turn)

    def rays(self):
        """A direction per pixel, in the camera's frame, with z = 1."""
        s = self.sensor
        v, u = numpy.mgrid[: s.height, : s.width]
        x, y = (u - (s.width - 1) / 2) / s.focal, (v - (s.height - 1) / 2) / s.focal
        return numpy.dstack([x, y, numpy.ones_like(x)])

    def window(self, corners):
        """The slices of rows and columns in which a solid with these corners can be seen."""
        s = self.sensor
        p = (corners - self.eye) @ self.turn.T
        if p[:, 2].min() < 0.05:
            return slice(0, s.height), slice(0, s.width)
        u = s.focal * p[:, 0] / p[:, 2] + (s.width - 1) / 2
        v = s.focal * p[:, 1] / p[:, 2] + (s.height - 1) / 2
        clip = lambda low, high, most: slice(
            int(numpy.clip(low - 1, 0, most)), int(numpy.clip(high + 2, 0, most))
        )
        return clip(v.min(), v.max(), s.height), clip(u.min(), u.max(), s.width)


@dataclasses.dataclass
class Image:
    """What a camera sees, per pixel: depth along z (NaN: nothing), the number of the thing, its
    colour, and the cosine between ray and normal."""

    depth: numpy.ndarray
    thing: numpy.ndarray
    colour: numpy.ndarray
    cosine: numpy.ndarray


def cast(view, things):
    """The exact image. @param things pairs (number, solid); pixels that show nothing get the number
    -1."""
    rays = view.rays()
    shape = rays.shape[:2]
    depth = numpy.full(shape, numpy.inf)
    thing = numpy.full(shape, -1)
    colour = numpy.zeros((*shape, 3))
    cosine = numpy.ones(shape)
    for number, solid in things:
        rows, columns = view.window(solid.corners())
        part = rays[rows, columns].reshape(-1, 3)
        if len(part) == 0:
            continue
        directions = part @ view.turn  # from the camera to the world
        t, normals = solid.hits(view.eye, directions)
        size = rays[rows, columns].shape[:2]
        nearer = (t.reshape(size) < depth[rows, columns]).ravel()
        if not nearer.any():
            continue
        d = directions[nearer]
        flat = numpy.zeros(size, bool)
        flat.ravel()[nearer] = True
        cosines = numpy.abs((d * normals[nearer]).sum(axis=1)) / numpy.linalg.norm(d, axis=1)
        depth[rows, columns][flat] = t[nearer]
        thing[rows, columns][flat] = number
        colour[rows, columns][flat] = solid.colours(view.eye + t[nearer, None] * d)
        cosine[rows, columns][flat] = cosines
    depth[~numpy.isfinite(depth)] = numpy.nan
    return Image(depth, thing, colour * (0.55 + 0.45 * cosine)[..., None], cosine)


def smoothed(field, passes):
    """White noise, smoothed by passes of a 3 x 3 mean; each pass ends with a rescaling to the
    standard deviation 1."""
    for _ in range(passes):
        around = numpy.pad(field, 1, mode="edge")
        field = sum(
            around[i : i + field.shape[0], j : j + field.shape[1]]
            for i in range(3)
            for j in range(3)
        )
        field /= field.std()
    return field


def shadow(sensor, depth):
    """True where the projector, to the right of the camera, does not reach what the camera sees."""
    columns = numpy.arange(sensor.width)
    with numpy.errstate(invalid="ignore"):
        place = numpy.where(
            numpy.isfinite(depth), columns - sensor.focal * sensor.baseline / depth, numpy.inf
        )
    # `place` is the column in the projector's view. A point is hidden from the projector if a point
    # farther right in the camera's view lies farther left in the projector's view.
    least = numpy.minimum.accumulate(place[:, ::-1], axis=1)[:, ::-1]
    return place > least + 1.5


def ragged(sensor, image, generator):
    """The image in which each pixel measures a place near its own."""
    shape = image.depth.shape
    v, u = numpy.mgrid[: shape[0], : shape[1]]
    offset = lambda: numpy.rint(sensor.ragged * generator.standard_normal(shape)).astype(int)
    v = numpy.clip(v + offset(), 0, shape[0] - 1)
    u = numpy.clip(u + offset(), 0, shape[1] - 1)
    moved = Image(image.depth[v, u], image.thing[v, u], image.colour, image.cosine[v, u])
    # If the other place is on the same thing, the pixel measures its own place, because surfaces
    # must not become rough.
    same = moved.thing == image.thing
    moved.depth[same] = image.depth[same]
    moved.cosine[same] = image.cosine[same]
    return moved


def measured(view, image, generator):
    """The image that the sensor measures: noise, rounding, shadow, ragged edges, mixed pixels. A
    mixed pixel belongs to no thing: its number is -2."""
    sensor = view.sensor
    lost = (
        shadow(sensor, image.depth) if sensor.baseline > 0 else numpy.zeros_like(image.thing, bool)
    )
    image = ragged(sensor, image, generator)
    depth, thing = image.depth.copy(), image.thing.copy()
    around = numpy.pad(depth, 1, mode="edge")
    near, far = depth.copy(), depth.copy()
    for i in range(3):
        for j in range(3):
            other = around[i : i + depth.shape[0], j : j + depth.shape[1]]
            near, far = numpy.fmin(near, other), numpy.fmax(far, other)
    mixed = (far - near > 0.02 + 0.01 * near) & (generator.random(depth.shape) < sensor.mixed)
    share = generator.random(depth.shape)
    depth[mixed] = (share * near + (1 - share) * far)[mixed]
    thing[mixed] = -2
    if sensor.disparity_noise > 0:
        scale = sensor.focal * sensor.baseline
        noise = smoothed(generator.standard_normal(depth.shape), sensor.smooth)
        disparity = scale / depth + sensor.disparity_noise * noise
        depth = scale / (numpy.rint(disparity / sensor.disparity_step) * sensor.disparity_step)
    else:
        offset, slope = sensor.noise
        depth = depth + (offset + slope * depth) * generator.standard_normal(depth.shape)
    if sensor.depth_step > 0:
        depth = numpy.rint(depth / sensor.depth_step) * sensor.depth_step
    lost |= image.cosine < GRAZING * (1 + 0.3 * generator.standard_normal(depth.shape))
    lost |= generator.random(depth.shape) < 0.002
    with numpy.errstate(invalid="ignore"):
        lost |= ~((depth >= NEAREST) & (depth <= FARTHEST))
    depth[lost] = numpy.nan
    colour = numpy.clip(image.colour + 4 * generator.standard_normal(image.colour.shape), 0, 255)
    return Image(depth, thing, colour, image.cosine)
