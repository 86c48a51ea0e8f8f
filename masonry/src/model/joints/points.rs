//! Places and weights of contact points on one joint.

use super::PointRule;

/// One side of a joint: its nodes and the overlap, in fractions of the edge of this side.
pub(super) struct Face {
    /// Places of the nodes as fractions of the edge, increasing.
    pub(super) fractions: Vec<f64>,
    /// Start and end of the joint as fractions of the edge.
    pub(super) overlap: [f64; 2],
}

/// The place of a contact point on a joint and on the edges of both sides.
pub(super) struct PointPlace {
    /// Place of the point as a fraction of the joint from its start.
    pub(super) along: f64,
    /// Place of the point as a fraction of the edge of side `a`; zero for a support.
    pub(super) on_a: f64,
    /// Place of the point as a fraction of the edge of side `b`.
    pub(super) on_b: f64,
    /// Length that the point stands for \[m\].
    pub(super) weight: f64,
    /// Start and end of the length of `weight` as fractions of the edge of side `a`; zeros for a support.
    pub(super) span_on_a: [f64; 2],
    /// Start and end of the length of `weight` as fractions of the edge of side `b`.
    pub(super) span_on_b: [f64; 2],
}

/// A point on a joint: its place, its weight, and start and end of the part that it stands for, all in fractions of
/// the joint.
type Weighted = (f64, f64, [f64; 2]);

/// Places the points of a joint of the given length \[m\]. Places that are closer than `slack`, a fraction of the
/// joint, count as one. Returns no points if the rule is nodal pairs and there are no such pairs.
pub(super) fn place(
    rule: PointRule,
    a: Option<&Face>,
    b: &Face,
    length: f64,
    slack: f64,
) -> Vec<PointPlace> {
    let on_a = a.map(Face::nodes_on_joint);
    let on_b = b.nodes_on_joint();
    let weighted = match rule {
        PointRule::Vertices => trapezoid(&vertices(on_a.as_deref(), &on_b, slack)),
        PointRule::NodalPairs => tributary(&common(on_a.as_deref(), &on_b, slack)),
        PointRule::Gauss => gauss(&vertices(on_a.as_deref(), &on_b, slack)),
    };
    weighted
        .into_iter()
        .map(|(along, weight, span)| PointPlace {
            along,
            on_a: a.map_or(0.0, |side| side.to_edge(along)),
            on_b: b.to_edge(along),
            weight: weight * length,
            span_on_a: span.map(|s| a.map_or(0.0, |side| side.to_edge(s))),
            span_on_b: span.map(|s| b.to_edge(s)),
        })
        .collect()
}

impl Face {
    /// Returns the nodes of this side as fractions of the joint, increasing; some lie outside of 0..=1.
    fn nodes_on_joint(&self) -> Vec<f64> {
        let [start, end] = self.overlap;
        let mut places: Vec<f64> =
            self.fractions.iter().map(|f| (f - start) / (end - start)).collect();
        places.sort_by(f64::total_cmp);
        places
    }

    fn to_edge(&self, along: f64) -> f64 {
        let [start, end] = self.overlap;
        (start + (end - start) * along).clamp(0.0, 1.0)
    }
}

/// Returns the ends of the parts on which displacements of both sides are linear: both ends of the joint and all nodes
/// inside.
fn vertices(a: Option<&[f64]>, b: &[f64], slack: f64) -> Vec<f64> {
    let nodes = a.unwrap_or_default().iter().chain(b);
    let mut inside: Vec<f64> = nodes.copied().filter(|x| *x > slack && *x < 1.0 - slack).collect();
    inside.sort_by(f64::total_cmp);
    inside.dedup_by(|next, kept| *next - *kept <= slack);
    let mut all = vec![0.0];
    all.append(&mut inside);
    all.push(1.0);
    all
}

/// Returns the places at which both sides have a node; the nodes of side `b` if side `a` is a support.
fn common(a: Option<&[f64]>, b: &[f64], slack: f64) -> Vec<f64> {
    let on_joint = b.iter().filter(|x| **x >= -slack && **x <= 1.0 + slack);
    let paired = on_joint.filter(|x| a.is_none_or(|a| a.iter().any(|y| (*x - y).abs() <= slack)));
    paired.map(|x| x.clamp(0.0, 1.0)).collect()
}

/// Returns the points with trapezoidal weights: half of every part goes to each of its ends.
fn trapezoid(places: &[f64]) -> Vec<Weighted> {
    let mut weighted: Vec<Weighted> = places.iter().map(|x| (*x, 0.0, [*x; 2])).collect();
    for k in 1..places.len() {
        let half = 0.5 * (places[k] - places[k - 1]);
        weighted[k - 1].1 += half;
        weighted[k].1 += half;
        let middle = places[k - 1] + half;
        weighted[k - 1].2[1] = middle;
        weighted[k].2[0] = middle;
    }
    weighted
}

/// Returns the points with tributary weights: every point stands for the part that is nearer to it than to any other
/// point.
fn tributary(places: &[f64]) -> Vec<Weighted> {
    let middle = |k: usize| 0.5 * (places[k - 1] + places[k]);
    let last = places.len();
    (0..last)
        .map(|k| {
            let from = if k == 0 { 0.0 } else { middle(k) };
            let to = if k + 1 == last { 1.0 } else { middle(k + 1) };
            (places[k], to - from, [from, to])
        })
        .collect()
}

/// Returns two Gauss points in every part.
fn gauss(places: &[f64]) -> Vec<Weighted> {
    let offset = 0.5 / 3.0_f64.sqrt();
    places
        .windows(2)
        .flat_map(|part| {
            let (length, middle) = (part[1] - part[0], 0.5 * (part[0] + part[1]));
            [(-offset, [part[0], middle]), (offset, [middle, part[1]])]
                .map(|(s, span)| (middle + s * length, 0.5 * length, span))
        })
        .collect()
}
