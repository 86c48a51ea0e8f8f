//! Connected parts.

/// Sets that grow together (Tarjan 1975).
pub(crate) struct Parts {
    parent: Vec<usize>,
    count: usize,
}

impl Parts {
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..count).collect(), count }
    }

    /// Whether all elements are in one part.
    pub(crate) fn is_one(&self) -> bool {
        self.count <= 1
    }

    /// The element that represents the part of another.
    pub(crate) fn of(&mut self, mut i: usize) -> usize {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    /// Joins the parts of two elements; the element with the lower number represents the result.
    pub(crate) fn join(&mut self, i: usize, j: usize) {
        let (i, j) = (self.of(i), self.of(j));
        if i != j {
            self.parent[i.max(j)] = i.min(j);
            self.count -= 1;
        }
    }

    pub(crate) fn join_all(&mut self, mut elements: impl Iterator<Item = usize>) {
        if self.is_one() {
            return;
        }
        if let Some(first) = elements.next() {
            elements.for_each(|i| self.join(first, i));
        }
    }

    /// The elements of every part in ascending order, the parts by their first elements.
    pub(crate) fn groups(&mut self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut group_of = vec![None; self.parent.len()];
        for i in 0..self.parent.len() {
            let first = self.of(i);
            let group = *group_of[first].get_or_insert_with(|| {
                groups.push(Vec::new());
                groups.len() - 1
            });
            groups[group].push(i);
        }
        groups
    }
}
