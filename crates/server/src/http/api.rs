//! The routes, and the document that describes them, which comes of the same list.

use super::{Failure, Problem, Site, calls, debug, lease, lsp};
use crate::desk;
use axum::{
    Extension, Router,
    body::Bytes,
    http::{StatusCode, header},
    middleware,
    response::{IntoResponse, Response},
};
use std::{iter, sync::Arc};
use utoipa::{
    OpenApi, ToSchema,
    openapi::{
        Content, Ref, RefOr, Type,
        path::{Operation, ParameterBuilder, ParameterIn, PathItem},
        response::ResponseBuilder,
        schema::{ObjectBuilder, SchemaType},
        security::{Http, HttpAuthScheme, SecurityRequirement, SecurityScheme},
    },
};
use utoipa_axum::{router::OpenApiRouter, routes};

/// What stands in paths.
const PLACES: [(&str, &str); 7] = [
    ("model", "Name of a model"),
    ("device", "Name of a device"),
    ("axis", "Name of an axis: `0`, or `X`, `Y`, `Z`, `U`"),
    ("pin", "Name of a pin as in the manuals"),
    ("id", "Number of a fault"),
    ("parameter", "Id of a parameter, as in the catalog of the model"),
    ("program", "Number of a program, from 0"),
];

/// The name of the way in which the token is shown.
const TOKEN: &str = "token";

/// What the document says before its paths.
#[derive(OpenApi)]
#[openapi(
    info(
        title = "Pulsetrain",
        description = "Stepper motion controllers. Every request shows the token that stands in the `ready http` \
                       line: `Authorization: Bearer TOKEN`, or `?token=TOKEN` for WebSockets."
    ),
    components(schemas(Problem))
)]
struct Head;

/// The document as text.
#[derive(Clone)]
struct Document(Bytes);

/// All routes of the interface.
pub(super) fn routes(site: &Arc<Site>) -> Router<Arc<Site>> {
    let check = middleware::from_fn_with_state(Arc::clone(site), lease::check);
    let (router, document) = free()
        .merge(naming_lease(led()).route_layer(check))
        .merge(naming_lease(desk::judging()))
        .split_for_parts();
    let text = complete(document).to_json().expect("a document becomes JSON");
    router.layer(Extension(Document(text.into())))
}

/// What everybody with the token may do at any time.
fn free() -> OpenApiRouter<Arc<Site>> {
    OpenApiRouter::with_openapi(Head::openapi())
        .routes(routes!(openapi))
        .routes(routes!(lease::show, lease::take, lease::renew, lease::drop))
        .routes(routes!(lsp::lsp))
        .merge(desk::free())
}

/// What changes something, which is for the holder of control while there is one; and looking at the same things.
fn led() -> OpenApiRouter<Arc<Site>> {
    use calls::{axes, devices, faults, pins, power};
    desk::led()
        .routes(routes!(devices::stream))
        .routes(routes!(pins::read, pins::drive, pins::release))
        .routes(routes!(axes::set_load))
        .routes(routes!(axes::push))
        .routes(routes!(axes::lose))
        .routes(routes!(axes::turn_pulser))
        .routes(routes!(faults::list, faults::add, faults::clear_all))
        .routes(routes!(faults::clear))
        .routes(routes!(debug::state, debug::set, debug::go))
        .routes(routes!(power::cycle))
        .routes(routes!(power::cut))
}

/// Adds the lease to the description of what may need it.
fn naming_lease(mut router: OpenApiRouter<Arc<Site>>) -> OpenApiRouter<Arc<Site>> {
    for item in router.get_openapi_mut().paths.paths.values_mut() {
        for change in [&mut item.put, &mut item.post, &mut item.patch, &mut item.delete].into_iter().flatten()
        {
            let lease = ParameterBuilder::new()
                .name("Control-Lease")
                .parameter_in(ParameterIn::Header)
                .description(Some("Needed while somebody has control: what it was given with"))
                .schema(Some(text()));
            change.parameters.get_or_insert_default().push(lease.build().into());
        }
    }
    router
}

/// This document
#[utoipa::path(get, path = "/api/openapi.json", tag = "document", responses((status = 200, body = serde_json::Value)))]
async fn openapi(Extension(Document(text)): Extension<Document>) -> Response {
    ([(header::CONTENT_TYPE, "application/json")], text).into_response()
}

/// Adds what is the same everywhere: what stands in paths, the token, and what an error looks like.
fn complete(mut document: utoipa::openapi::OpenApi) -> utoipa::openapi::OpenApi {
    let bearer = SecurityScheme::Http(Http::new(HttpAuthScheme::Bearer));
    document.components.get_or_insert_default().add_security_scheme(TOKEN, bearer);
    document.security = Some(vec![SecurityRequirement::new::<_, [&str; 0], &str>(TOKEN, [])]);
    for (path, item) in &mut document.paths.paths {
        let places: Vec<_> = path.split(['{', '}']).skip(1).step_by(2).map(place).collect();
        for (method, operation) in operations(item) {
            // Names of functions are told apart by their modules, these are not.
            let words = path.split(['/', '{', '}', '.', '-']).filter(|word| !matches!(*word, "" | "api"));
            let id = iter::once(method).chain(words).collect::<Vec<_>>().join("_");
            operation.operation_id = Some(id);
            let own = operation.parameters.get_or_insert_default();
            own.retain(|one| !matches!(one, RefOr::T(one) if one.parameter_in == ParameterIn::Path));
            own.splice(..0, places.iter().map(|place| place.clone().into()));
            let problem = Content::new(Some(Ref::from_schema_name(Problem::name())));
            let problem = ResponseBuilder::new().description("Error").content("application/json", problem);
            operation.responses.responses.insert("default".into(), problem.build().into());
            for (status, response) in &mut operation.responses.responses {
                if let RefOr::T(response) = response
                    && response.description.is_empty()
                {
                    let status = status.parse().ok().and_then(|status| StatusCode::from_u16(status).ok());
                    response.description =
                        status.and_then(|status| status.canonical_reason()).unwrap_or_default().into();
                }
            }
        }
    }
    document
}

fn operations(item: &mut PathItem) -> impl Iterator<Item = (&'static str, &mut Operation)> {
    let PathItem { get, put, post, patch, delete, .. } = item;
    let all = [("get", get), ("put", put), ("post", post), ("patch", patch), ("delete", delete)];
    all.into_iter().filter_map(|(method, operation)| Some((method, operation.as_mut()?)))
}

fn place(name: &str) -> utoipa::openapi::path::Parameter {
    let (_, about) = PLACES.iter().find(|(known, _)| *known == name).expect("every place in paths is listed");
    let parameter = ParameterBuilder::new().name(name).parameter_in(ParameterIn::Path);
    parameter.description(Some(*about)).schema(Some(text())).build()
}

fn text() -> utoipa::openapi::schema::Schema {
    ObjectBuilder::new().schema_type(SchemaType::new(Type::String)).build().into()
}

/// No route has this path.
pub(super) async fn nowhere() -> Failure {
    Failure::new(StatusCode::NOT_FOUND, "there is nothing here")
}

/// The route does not have this method.
pub(super) async fn no_method() -> Failure {
    Failure::new(StatusCode::METHOD_NOT_ALLOWED, "this path does not take that method")
}
