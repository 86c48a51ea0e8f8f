//! Access control: only pages of this server get answers.

use std::io;

use super::http::{Head, Reply};

/// The header in which a page sends the token. A page of another origin cannot send this header without a preflight
/// request, which the server refuses.
const TOKEN: &str = "x-masonry-token";

/// The address of the server, and the token that requests must carry.
#[derive(Debug)]
pub(super) struct Guard {
    port: u16,
    token: String,
}

impl Guard {
    pub(super) fn new(port: u16) -> io::Result<Self> {
        Ok(Self { port, token: secret()? })
    }

    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/?token={}", self.port, self.token)
    }

    /// Refuses requests that name another host, come from another origin, or lack the token.
    ///
    /// # Errors
    /// The reply that states the reason.
    pub(super) fn check(&self, head: &Head<'_>) -> Result<(), Reply> {
        let host = format!("127.0.0.1:{}", self.port);
        // The name of another host can lead to this address as well, and pages of that host would then have the same
        // origin as pages of this server.
        if head.header("host") != Some(host.as_str()) {
            return Err(Reply::error(
                403,
                "this is another host: open the address that the command has printed",
            ));
        }
        let origin = head.header("origin");
        if origin.is_some_and(|it| it != format!("http://{host}")) {
            return Err(Reply::error(403, "another page has no access"));
        }
        let site = head.header("sec-fetch-site");
        if site.is_some_and(|it| it != "same-origin" && it != "none") {
            return Err(Reply::error(403, "another page has no access"));
        }
        let in_address = head.query.and_then(|it| it.strip_prefix("token="));
        let token = if head.path == "/" { in_address } else { head.header(TOKEN) };
        if token.is_some_and(|it| self.is_token(it)) {
            Ok(())
        } else {
            Err(Reply::error(
                403,
                "the token is missing: open the address that the command has printed",
            ))
        }
    }

    /// Compares all characters of the given token, so that the time does not depend on the first difference.
    fn is_token(&self, given: &str) -> bool {
        let differences = self.token.bytes().zip(given.bytes()).map(|(a, b)| a ^ b);
        given.len() == self.token.len() && differences.fold(0, |all, it| all | it) == 0
    }
}

/// Returns a random word that nobody can guess.
pub(super) fn secret() -> io::Result<String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(io::Error::other)?;
    Ok(format!("{:032x}", u128::from_le_bytes(bytes)))
}
