//! What a workspace keeps from step to step, for checkpoints.

use super::Workspace;
use super::record::Ledger;
use crate::checkpoint::{CheckpointError, rows};
use crate::contacts::ContactKey;
use crate::space::Space;
use serde::{Deserialize, Serialize};

/// The impulses that the next solve may start from, the sums of the ledger, and how many problems were kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct WorkspaceState {
    ledger: Ledger,
    keys: Vec<ContactKey>,
    impulses: Vec<f64>,
    joints: Vec<f64>,
    last: Vec<f64>,
    swept: u64,
    failed: u64,
}

impl<S: Space<D, N>, const D: usize, const N: usize> Workspace<S, D, N> {
    pub(crate) fn state(&self) -> WorkspaceState {
        WorkspaceState {
            ledger: self.ledger,
            keys: self.previous.iter().map(|(key, _)| *key).collect(),
            impulses: self.previous.iter().flat_map(|(_, impulse)| *impulse).collect(),
            joints: self.joints.previous.as_flattened().to_vec(),
            last: self.last.as_flattened().to_vec(),
            swept: self.swept,
            failed: self.failed.count,
        }
    }

    pub(crate) fn restore(&mut self, state: &WorkspaceState) -> Result<(), CheckpointError> {
        let WorkspaceState { ledger, keys, impulses, joints, last, swept, failed } = state;
        let wrong = || CheckpointError::misfit("impulses are none that a run could have");
        let impulses = rows(impulses, keys.len()).ok_or_else(wrong)?;
        if !keys.is_sorted() {
            return Err(wrong());
        }
        self.previous = keys.iter().copied().zip(impulses).collect();
        self.joints.previous = rows(joints, joints.len() / D).ok_or_else(wrong)?;
        self.last = rows(last, last.len() / N).ok_or_else(wrong)?;
        (self.ledger, self.swept, self.failed.count) = (*ledger, *swept, *failed);
        Ok(())
    }
}
